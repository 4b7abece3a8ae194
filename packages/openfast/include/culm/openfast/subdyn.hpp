/// SubDyn's input file: the members of a substructure.
#pragma once

#include <culm/math/types.hpp>
#include <culm/openfast/report.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace culm::openfast {

/// A point that members share.
struct SubJoint {
  enum class Kind { rigid, universal, revolute, spherical };
  int id = 0;
  Vec3 place = Vec3::Zero();  ///< [m]
  Kind kind = Kind::rigid;    ///< how members turn against each other
  Vec3 axis = Vec3::Zero();   ///< of a revolute joint
};

/// A section of a beam. Axes x, y of the member, z along it.
struct SubSection {
  int id = 0;
  bool is_tube = false;
  double young = 0.0, shear = 0.0;     ///< moduli [N/m^2]
  double density = 0.0;                ///< [kg/m^3]
  double diameter = 0.0, wall = 0.0;   ///< of a tube [m]
  double area = 0.0;                   ///< [m^2]
  std::array<double, 2> shear_area{};  ///< along x, y [m^2]
  std::array<double, 2> bending{};     ///< about x, y [m^4]
  double twist = 0.0;                  ///< [m^4]
};

/// A tension member, or a rigid one, which has no stiffness.
struct SubLink {
  int id = 0;
  double stiffness = 0.0;  ///< EA [N]
  double density = 0.0;    ///< [kg/m]
  double tension = 0.0;    ///< at its length in the file [N]
};

/// A line between two joints.
struct SubMember {
  enum class Kind { beam, cable, rigid };
  int id = 0;
  std::array<std::size_t, 2> joints{};      ///< places in the list of joints
  std::array<std::size_t, 2> properties{};  ///< places in the list of sections, or of links
  Kind kind = Kind::beam;
  Vec3 x = Vec3::Zero();  ///< axis x of its sections
};

/// A joint that is held or stands on soft ground: displacements along x, y, z, rotations about
/// them.
struct SubSupport {
  std::size_t joint = 0;
  std::array<bool, 6> held{};
  Mat6 stiffness = Mat6::Zero();  ///< of the ground, against what is free [N/m, N, N m]

  /// Whether the ground or a support resists a displacement or rotation.
  bool resists(std::size_t k) const {
    return held[k] || stiffness(static_cast<int>(k), static_cast<int>(k)) > 0.0;
  }
  /// Whether something is free on ground that resists.
  bool is_soft() const {
    return !stiffness.isZero(0.0) && std::find(held.begin(), held.end(), false) != held.end();
  }
};

/// A body at a joint.
struct SubMass {
  std::size_t joint = 0;
  double mass = 0.0;            ///< [kg]
  Vec3 centre = Vec3::Zero();   ///< from the joint [m]
  Mat3 inertia = Mat3::Zero();  ///< about the centre [kg m^2]
};

/// The file.
struct SubDyn {
  std::filesystem::path path;
  std::string title;
  int divisions = 1;     ///< elements of a member
  double damping = 0.0;  ///< proportional to the stiffness [s]
  std::vector<SubJoint> joints;
  std::vector<SubMember> members;
  std::vector<SubSection> sections;
  std::vector<SubLink> cables, rigid_links;
  std::vector<SubSupport> supports;
  std::vector<std::size_t> interface;  ///< joints that carry what stands on the substructure
  std::vector<SubMass> masses;
};

/// Length of a member [m].
double length_of(const SubDyn& file, const SubMember& member);
/// Mass of a member, area times density linear between its sections [kg].
double mass_of(const SubDyn& file, const SubMember& member);

/// Throws InputError, FileError; tells the report what it found.
SubDyn read_subdyn(const std::filesystem::path& path, Report& report);

}  // namespace culm::openfast
