// Embree 3 (Debian 12) or 4 (newer releases), whichever there is.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
