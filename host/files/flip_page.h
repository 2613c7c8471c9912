// Two images and their difference in one place of an HTML page, for flipping between them.
#pragma once

#include <string>

#include "files/image.h"

namespace phlux::files {

/// The text of an HTML page that contains compare_picture()'s three pictures and no reference to other files.
/// Keys 1, 2 and 3 show A, B and the difference; a click flips between A and B. Arguments as
/// compare_picture()'s.
[[nodiscard]] std::string flip_page(const Image& a, const Image& b, const std::string& name_a,
                                    const std::string& name_b);

} // namespace phlux::files
