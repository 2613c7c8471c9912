// Output buffers of standard streams.
#pragma once

#include <cerrno>
#include <cstddef>
#include <streambuf>
#include <vector>

#include <unistd.h>

namespace phlux::files {

/// Collects 64 KiB before sync() has to pass on what is between pbase() and pptr(); it then calls start().
class OutputBuffer : public std::streambuf {
protected:
  OutputBuffer() : bytes_(std::size_t{1} << 16) { start(); }

  void start() { setp(bytes_.data(), bytes_.data() + bytes_.size()); }

  int_type overflow(int_type byte) override {
    if (sync() != 0) return traits_type::eof();
    return traits_type::eq_int_type(byte, traits_type::eof()) ? traits_type::not_eof(byte)
                                                              : sputc(traits_type::to_char_type(byte));
  }

private:
  std::vector<char> bytes_;
};

/// Writes to a file that is open for writing and can seek. After a failure nothing more is written, and the
/// stream is bad.
class FileBuffer final : public OutputBuffer {
public:
  explicit FileBuffer(int descriptor) : descriptor_(descriptor) {}
  /// errno of the first write that failed; 0: none did
  [[nodiscard]] int error() const { return error_; }

protected:
  int sync() override {
    for (const char* at = pbase(); at < pptr() && error_ == 0;) {
      const ssize_t written = ::write(descriptor_, at, static_cast<std::size_t>(pptr() - at));
      if (written >= 0)
        at += written;
      else if (errno != EINTR)
        error_ = errno;
    }
    start();
    return error_ == 0 ? 0 : -1;
  }
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const bool asks = offset == 0 && from == std::ios_base::cur; // tellp()
    const off_type waiting = pptr() - pbase();
    if (!asks && sync() != 0) return pos_type(off_type(-1));
    const int whence = from == std::ios_base::beg   ? SEEK_SET
                       : from == std::ios_base::cur ? SEEK_CUR
                                                    : SEEK_END;
    const off_type position = ::lseek(descriptor_, offset, whence);
    return pos_type(position < 0 ? position : position + (asks ? waiting : 0));
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }

private:
  int descriptor_;
  int error_ = 0;
};

} // namespace phlux::files
