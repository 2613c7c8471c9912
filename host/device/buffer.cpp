#include "device/buffer.h"

#include <cstring>
#include <memory>
#include <new>

#include "large_pages.h"

namespace phlux::device {
namespace {

struct Pages {
  void* memory;
  std::size_t bytes;

  explicit Pages(std::size_t size) : memory(map_large_pages(size)), bytes(size) {}
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;
  ~Pages() { unmap_large_pages(memory, bytes); }
};

void CL_CALLBACK free_pages(cl_mem, void* pages) {
  delete static_cast<Pages*>(pages);
}

} // namespace

cl::Buffer make_buffer(const Device& device, cl_mem_flags flags, std::size_t bytes, const void* data) {
  if (device.info.type != "cpu") {
    if (data != nullptr) flags |= CL_MEM_COPY_HOST_PTR;
    return {device.context, flags, bytes, const_cast<void*>(data)};
  }
  std::unique_ptr<Pages> pages;
  try {
    pages = std::make_unique<Pages>(bytes);
  } catch (const std::bad_alloc&) {
    throw cl::Error(CL_MEM_OBJECT_ALLOCATION_FAILURE, "mmap");
  }
  if (data != nullptr) std::memcpy(pages->memory, data, bytes);
  cl::Buffer buffer(device.context, flags | CL_MEM_USE_HOST_PTR, bytes, pages->memory);
  buffer.setDestructorCallback(free_pages, pages.get());
  static_cast<void>(pages.release());
  return buffer;
}

} // namespace phlux::device
