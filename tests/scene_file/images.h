// Small image files.
#pragma once

#include <string>
#include <vector>

namespace phlux::test {

/// Bytes from pairs of hexadecimal digits.
inline std::string from_hex(const std::string& digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  return bytes;
}

/// 2x2 pixels of 8 bits: 255 0 0, 0 128 0; 0 0 64, 10 20 30.
inline std::string png() {
  return from_hex(
      "89504e470d0a1a0a0000000d4948445200000002000000020802000000fdd49a73000000144944415478da63f8cfc0c0"
      "d000c40c0e5c22720012e501fc49d2f2030000000049454e44ae426082");
}

/// 2x1 pixels of 8 bits with alpha: 255 128 0 64, 10 20 30 255.
inline std::string png_with_alpha() {
  return from_hex(
      "89504e470d0a1a0a0000000d4948445200000002000000010806000000f4227f8a000000114944415478da63f8dfc0e0"
      "c02522f71f000e6002fb8b82fc170000000049454e44ae426082");
}

/// 2x1 grey pixels of 16 bits: 65535, 1000.
inline std::string png_of_16_bits() {
  return from_hex(
      "89504e470d0a1a0a0000000d494844520000000200000001100000000081d9fc150000000d4944415478da63f8ff9ff905"
      "0007ec02ea8f243cfc0000000049454e44ae426082");
}

/// 8x8 grey pixels of 200: the only coefficient is (200 - 128) 8, of ten bits.
inline std::string jpeg() {
  std::string ones(64, '\1');
  return from_hex("ffd8ffdb004300") + ones +
         from_hex("ffc0000b080008000801011100ffc40014000100000000000000000000000000000"
                  "00affc400141001000000000000000000000000000000"
                  "00ffda0008010100003f00480fffd9");
}

/// A BMP of 24 bits: two rows from the bottom, blue first, padded to 4 bytes. Pixels: 1 2 3, 4 5 6; 7 8 9, 10
/// 11 12.
inline std::string bmp() {
  return from_hex(
      "424d460000000000000036000000280000000200000002000000010018000000000010000000130b0000130b000000000000"
      "000000000908070c0b0a00000302010605040000");
}

/// An uncompressed TGA of 24 bits from the top: 1 2 3, 4 5 6.
inline std::string tga() {
  return from_hex("000002000000000000000000020001001820030201060504");
}

/// 1x1 pixel of RGBE: 0.5, 0.25, 8.
inline std::string hdr() {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + from_hex("08048084");
}

/// An OpenEXR file of channels that all have these values, `width` a row; each channel's name is one letter.
std::string exr(const std::string& channels, const std::vector<float>& values, int width);

} // namespace phlux::test
