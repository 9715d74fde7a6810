// What the machine is to blame for, as opposed to a definition.
#pragma once

#include "rubble/error.h"

namespace rubble {

/// Thrown when the machine lacks what is needed: a GL context or its memory, a shader file, room on a disk.
/// The definition may be right: the same call may work elsewhere or later.
class MachineError : public Error {
 public:
  using Error::Error;
};

}  // namespace rubble
