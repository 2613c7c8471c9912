// Shows images in tev (github.com/Tom94/tev), an image viewer that listens on a TCP port.
#pragma once

#include <string>

#include "files/image.h"

namespace phlux::files {

inline constexpr const char* tev_address = "127.0.0.1:14158"; ///< where tev listens unless told otherwise

/// tev's packets that create the image `name` with all of its channels: the length in bytes, itself included
/// (little-endian uint32), the packet's type (a byte), then its fields; texts end with a 0. Rows are sent in
/// bands, so that a packet stays small.
[[nodiscard]] std::string tev_packets(const Image& image, const std::string& name);

/// Sends them to the tev at HOST:PORT. Returns false if nothing listens there.
/// @throws UsageError for a text that is no HOST:PORT, WriteError if the connection breaks
[[nodiscard]] bool show_in_tev(const Image& image, const std::string& name, const std::string& address);

} // namespace phlux::files
