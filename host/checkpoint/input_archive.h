// Reads what cereal::PortableBinaryOutputArchive has written, from a file that may be forged.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <istream>
#include <type_traits>

#include <cereal/archives/portable_binary.hpp>

namespace phlux::checkpoint {

/// Reads at most `bytes` bytes of a stream. A length above the number of bytes that are left is refused
/// before memory is taken for it. @throws cereal::Exception for a stream that ends early or is not of this
/// kind
class InputArchive : public cereal::InputArchive<InputArchive, cereal::AllowEmptyClassElision> {
public:
  InputArchive(std::istream& stream, std::uint64_t bytes)
      : cereal::InputArchive<InputArchive, 1>(this), stream_(stream), left_(bytes) {
    std::uint8_t little_endian = 0;
    read(&little_endian, 1, 1);
    swap_ = (little_endian == 1) != (std::endian::native == std::endian::little);
  }

  void check_length(std::uint64_t elements) const {
    if (elements > left_) throw cereal::Exception("a length beyond the end");
  }

  /// `size` bytes: numbers of `number_bytes` each.
  void read(void* to, std::uint64_t size, std::size_t number_bytes) {
    check_length(size);
    auto* const bytes = static_cast<char*>(to);
    if (!stream_.read(bytes, static_cast<std::streamsize>(size))) throw cereal::Exception("the end");
    left_ -= size;
    if (swap_)
      for (std::uint64_t i = 0; i < size; i += number_bytes)
        std::reverse(bytes + i, bytes + i + number_bytes);
  }

private:
  std::istream& stream_;
  std::uint64_t left_;
  bool swap_ = false;
};

template<class T>
requires std::is_arithmetic_v<T>
void CEREAL_LOAD_FUNCTION_NAME(InputArchive& archive, T& number) {
  if constexpr (std::is_same_v<T, bool>) { // of which a file may have other values than 0 and 1
    std::uint8_t byte = 0;
    archive.read(&byte, 1, 1);
    number = byte != 0;
  } else {
    archive.read(&number, sizeof number, sizeof number);
  }
}
template<class T>
void CEREAL_LOAD_FUNCTION_NAME(InputArchive& archive, cereal::BinaryData<T>& data) {
  archive.read(data.data, data.size, sizeof(std::remove_pointer_t<std::remove_reference_t<T>>));
}
template<class T>
void CEREAL_LOAD_FUNCTION_NAME(InputArchive& archive, cereal::NameValuePair<T>& pair) {
  archive(pair.value);
}
template<class T>
void CEREAL_LOAD_FUNCTION_NAME(InputArchive& archive, cereal::SizeTag<T>& tag) {
  archive(tag.size);
  archive.check_length(tag.size);
}

} // namespace phlux::checkpoint

// The archive that writes what it reads.
template<>
struct cereal::traits::detail::get_output_from_input<phlux::checkpoint::InputArchive> {
  using type = cereal::PortableBinaryOutputArchive;
};
