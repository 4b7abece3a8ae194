#include <culm/base/schema.hpp>

#include "vector_fields.hpp"

namespace culm::model {
namespace {

class UniformField final : public VectorField {
 public:
  explicit UniformField(const Vec3& vector) : vector_(vector) {}
  Vec3 value(const Vec3&, double) const override { return vector_; }
  bool varies_in_time() const override { return false; }
  Mat3 gradient(const Vec3&, double) const override { return Mat3::Zero(); }

 private:
  Vec3 vector_;
};

}  // namespace

void register_uniform_field(FieldRegistry& registry) {
  registry.add("Uniform",
               Schema("Uniform", "The same everywhere and at all times.")
                   .add(numbers("Vector", "1", "Components in space.").size(3)),
               [](const Options& options) {
                 return std::make_shared<UniformField>(
                     Eigen::Map<const Vec3>(options.numbers("Vector").data()));
               });
}

}  // namespace culm::model
