#include "scene_file/images.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include "temporary_folder.h"

namespace phlux::test {

std::string exr(const std::string& channels, const std::vector<float>& values, int width) {
  const TemporaryFolder folder;
  const int height = static_cast<int>(values.size()) / width;
  Imf::Header header(width, height);
  Imf::FrameBuffer frame;
  std::vector<float> copy = values;
  for (const char name : channels) {
    header.channels().insert(std::string(1, name), Imf::Channel(Imf::FLOAT));
    frame.insert(std::string(1, name), Imf::Slice::Make(Imf::FLOAT, copy.data(), header.dataWindow()));
  }
  {
    Imf::OutputFile file((folder / "image.exr").string().c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  return TemporaryFolder::read(folder / "image.exr");
}

} // namespace phlux::test
