// Bullet's float and double builds have classes of other sizes. Everything of ours that touches Bullet lives
// in an inline namespace named after the precision, so that a mixed build fails at link and not at run time.
#pragma once

#include <LinearMath/btScalar.h>

#ifdef BT_USE_DOUBLE_PRECISION
#define RUBBLE_ABI_BEGIN inline namespace bullet_float64 {
#else
#define RUBBLE_ABI_BEGIN inline namespace bullet_float32 {
#endif
#define RUBBLE_ABI_END }
