#include "files/font.h"

#include <cstddef>
#include <iterator>

namespace phlux::files {
namespace {

constexpr std::size_t glyphs_in_a_strip = 16, height = glyph_height, advance = glyph_width + 1;

// ASCII from the space on; the last glyph, in the place of the control character DEL, is the box.
constexpr std::string_view strips[] = {
    //       !     "     #     $     %     &     '     (     )     *     +     ,     -     .     /
    "        #    # #   # #    #   ##  #  ##     #      #   #                                      #",
    "        #    # #   # #   #### ##  # #  #    #     #     #     #     #                         #",
    "        #         ##### # #      #  # #          #       #  # # #   #                        # ",
    "        #          # #   ###    #    #           #       #   ###  #####       #####         #  ",
    "        #         #####   # #  #    # # #        #       #  # # #   #                      #   ",
    "                   # #  ####  #  ## #  #          #     #     #     #    ##          ##   #    ",
    "        #          # #    #   #  ##  ## #          #   #                 ##          ##   #    ",
    "                                                                          #                    ",
    "                                                                         #                     ",

    // 0     1     2     3     4     5     6     7     8     9     :     ;     <     =     >     ?
    " ###    #    ###   ###     #  #####  ###  #####  ###   ###                 #         #     ### ",
    "#   #  ##   #   # #   #   ##  #     #         # #   # #   #  ##    ##     #           #   #   #",
    "#  ##   #       #     #  # #  ####  #        #  #   # #   #  ##    ##    #    #####    #      #",
    "# # #   #     ##    ##  #  #      # ####     #   ###   ####             #               #    # ",
    "##  #   #    #        # #####     # #   #   #   #   #     #              #    #####    #    #  ",
    "#   #   #   #     #   #    #  #   # #   #   #   #   #     #  ##    ##     #           #        ",
    " ###   ###  #####  ###     #   ###   ###    #    ###   ###   ##    ##      #         #      #  ",
    "                                                                    #                          ",
    "                                                                   #                           ",

    // @     A     B     C     D     E     F     G     H     I     J     K     L     M     N     O
    " ###   ###  ####   ###  ####  ##### #####  ###  #   #  ###    ### #   # #     #   # #   #  ### ",
    "#   # #   # #   # #   # #   # #     #     #   # #   #   #      #  #  #  #     ## ## ##  # #   #",
    "# ### #   # #   # #     #   # #     #     #     #   #   #      #  # #   #     # # # ##  # #   #",
    "# # # ##### ####  #     #   # ####  ####  # ### #####   #      #  ##    #     # # # # # # #   #",
    "# ### #   # #   # #     #   # #     #     #   # #   #   #      #  # #   #     #   # #  ## #   #",
    "#     #   # #   # #   # #   # #     #     #   # #   #   #   #  #  #  #  #     #   # #  ## #   #",
    " #### #   # ####   ###  ####  ##### #      #### #   #  ###   ##   #   # ##### #   # #   #  ### ",
    "                                                                                               ",
    "                                                                                               ",

    // P     Q     R     S     T     U     V     W     X     Y     Z     [     \     ]     ^     _
    "####   ###  ####   #### ##### #   # #   # #   # #   # #   # #####   ##  #      ##     #        ",
    "#   # #   # #   # #       #   #   # #   # #   # #   # #   #     #   #   #       #    # #       ",
    "#   # #   # #   # #       #   #   # #   # #   #  # #   # #     #    #    #      #   #   #      ",
    "####  #   # ####   ###    #   #   # #   # # # #   #     #     #     #     #     #              ",
    "#     # # # # #       #   #   #   #  # #  # # #  # #    #    #      #      #    #              ",
    "#     #  #  #  #      #   #   #   #  # #  ## ## #   #   #   #       #       #   #              ",
    "#      ## # #   # ####    #    ###    #   #   # #   #   #   #####   ##      #  ##              ",
    "                                                                                          #####",
    "                                                                                               ",

    // `     a     b     c     d     e     f     g     h     i     j     k     l     m     n     o
    " #          #               #         ##        #       #      #  #      ##                    ",
    "  #         #               #        #          #                 #       #                    ",
    "       ###  ####   ###   ####  ###   #     #### ####   ##     ##  #  #    #   ## #  ####   ### ",
    "          # #   # #   # #   # #   # ####  #   # #   #   #      #  # #     #   # # # #   # #   #",
    "       #### #   # #     #   # #####  #    #   # #   #   #      #  ##      #   # # # #   # #   #",
    "      #   # #   # #   # #   # #      #    #   # #   #   #      #  # #     #   # # # #   # #   #",
    "       #### ####   ###   ####  ####  #     #### #   #  ###     #  #  #   ###  # # # #   #  ### ",
    "                                              #                #                               ",
    "                                           ###               ##                                ",

    // p     q     r     s     t     u     v     w     x     y     z     {     |     }     ~     other
    "                         #                                           #    #    #          #####",
    "                         #                                          #     #     #         #   #",
    "####   #### # ##   #### ####  #   # #   # #   # #   # #   # #####   #     #     #    #    #   #",
    "#   # #   # ##  # #      #    #   # #   # # # #  # #  #   #    #   #      #      #  # # # #   #",
    "#   # #   # #      ###   #    #   #  # #  # # #   #   #   #   #     #     #     #      #  #   #",
    "#   # #   # #         #  #  # #   #  # #  # # #  # #  #   #  #      #     #     #         #   #",
    "####   #### #     ####    ##   ####   #    # #  #   #  #### #####    #    #    #          #####",
    "#         #                                               #                                    ",
    "#         #                                            ###                                     ",
};
static_assert(std::size(strips) * glyphs_in_a_strip == (128 - ' ') * height);

} // namespace

bool glyph_pixel(char character, int x, int y) {
  const auto code = static_cast<unsigned char>(character);
  const std::size_t glyph = (code < ' ' || code > 127 ? 127 : code) - std::size_t{' '};
  const std::string_view row = strips[glyph / glyphs_in_a_strip * height + static_cast<std::size_t>(y)];
  return row[glyph % glyphs_in_a_strip * advance + static_cast<std::size_t>(x)] == '#';
}

std::string glyphs_of(std::string_view text) {
  std::string glyphs(text);
  std::erase_if(glyphs, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; });
  return glyphs;
}

} // namespace phlux::files
