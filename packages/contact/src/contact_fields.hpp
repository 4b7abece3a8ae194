/// What types of contact read alike.
#pragma once

#include <culm/contact/contact_point.hpp>
#include <culm/contact/friction.hpp>
#include <culm/contact/penalty.hpp>
#include <culm/model/build_context.hpp>

#include <vector>

namespace culm::contact {

/// Parameters of the points that touch, and of the law of their depth.
void add_contact_fields(Schema& schema);
/// Adds issues where these parameters do not fit together.
void check_contact_fields(const Options& options, InputIssues& issues);
/// The points; none, and issues, if the deck asks for something that is not there.
std::vector<ContactPoint> read_points(const Options& options, model::BuildContext& context);
Penalty read_penalty(const Options& options);

/// Parameters "Friction" and "Slip Speed".
Field friction_field();
Field slip_speed_field();
Friction read_friction(const Options& options);

}  // namespace culm::contact
