/// The types of loads, one source each.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::load {

/// Every type of load, one line each: NAME stands for register_NAME of NAME.cpp.
#define CULM_LOADS(TYPE)                                                            \
  TYPE(force)                  /* Force, Follower Force */                          \
  TYPE(moment)                 /* Moment, Follower Moment */                        \
  TYPE(line_force)             /* Line Force, Follower Line Force */                \
  TYPE(line_moment)            /* Line Moment, Follower Line Moment */              \
  TYPE(line_load)              /* Line Load, Follower Line Load */                  \
  TYPE(field_force)            /* Field Force */                                    \
  TYPE(pressure)               /* Pressure */                                       \
  TYPE(surface_force)          /* Surface Force */                                  \
  TYPE(director_force)         /* Director Force */                                 \
  TYPE(gravity)                /* Gravity */                                        \
  TYPE(external)               /* External */                                       \
  TYPE(rotating_frame)         /* Rotating Frame */                                 \
  TYPE(catenary)               /* Catenary */                                       \
  TYPE(spring)                 /* Spring, Damper */                                 \
  TYPE(directed_spring)        /* Directed Spring, Directed Damper */               \
  TYPE(ground_spring)          /* Ground Spring, Ground Damper */                   \
  TYPE(directed_ground_spring) /* Directed Ground Spring, Directed Ground Damper */ \
  TYPE(plane_ground_spring)    /* Plane Ground Spring, Plane Ground Damper */       \
  TYPE(torsion)                /* Torsion Spring, Torsion Damper, Torsion Drive */  \
  TYPE(rotation_damper)        /* Rotation Damper, Rotation Damper Local */         \
  TYPE(restoring)              /* Restoring */

#define CULM_DECLARE(type) void register_##type(model::BuilderRegistry& registry);
CULM_LOADS(CULM_DECLARE)
#undef CULM_DECLARE

}  // namespace culm::load
