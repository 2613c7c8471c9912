#include "render/choices.h"

namespace phlux::render {
namespace {

template<class Value>
void fill(std::optional<Value>& value, const std::optional<Value>& earlier) {
  if (!value) value = earlier;
}

} // namespace

void Choices::complete(const Choices& earlier) {
  definitions.insert(earlier.definitions.begin(), earlier.definitions.end());
  fill(size, earlier.size);
  fill(integrator, earlier.integrator);
  fill(strategy, earlier.strategy);
  fill(connect, earlier.connect);
  fill(light_selection, earlier.light_selection);
  fill(connections, earlier.connections);
  fill(weights, earlier.weights);
  fill(max_depth, earlier.max_depth);
  fill(rr_depth, earlier.rr_depth);
  fill(ambient, earlier.ambient);
  fill(clamp, earlier.clamp);
  fill(seed, earlier.seed);
  fill(first_sample, earlier.first_sample);
  fill(double_precision, earlier.double_precision);
  if (lanes == 0 && !double_precision.value_or(false)) lanes = earlier.lanes;
  if (traversal == Traversal::automatic) traversal = earlier.traversal;
  if (samples_per_pixel || time_limit || target_error) return;
  samples_per_pixel = earlier.samples_per_pixel;
  time_limit = earlier.time_limit;
  target_error = earlier.target_error;
}

} // namespace phlux::render
