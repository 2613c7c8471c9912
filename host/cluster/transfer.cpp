#include "cluster/transfer.h"

#include <array>
#include <map>

namespace phlux::cluster {
namespace {

void add(const std::map<std::string, std::string>& texts, Packer& to) {
  to.add(std::uint64_t{texts.size()});
  for (const auto& [name, text] : texts) {
    to.add(name);
    to.add(text);
  }
}

std::map<std::string, std::string> take_texts(Unpacker& from) {
  std::map<std::string, std::string> texts;
  const auto count = from.take<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string name = from.take_text();
    texts[name] = from.take_text();
  }
  return texts;
}

// Of a batch.
struct Counts {
  std::uint64_t records, paths;
};

} // namespace

void add(const settings::Choices& choices, Packer& to) {
  const auto& [definitions, size, texts, auto_reasons] = choices; // workers write no files
  add(definitions, to);
  to.add(size.value_or(std::array{0, 0}));
  add(texts, to);
}

settings::Choices take_choices(Unpacker& from) {
  settings::Choices choices;
  choices.definitions = take_texts(from);
  if (const auto size = from.take<std::array<int, 2>>(); size[0] > 0) choices.size = size;
  choices.texts = take_texts(from);
  return choices;
}

void add(const render::LaunchResult& result, Packer& to) {
  to.add(result.launch);
  to.add(result.rays);
  to.add(result.shadow_rays);
  to.add(std::uint64_t{result.sums.size()});
  to.add_array(result.sums.data(), result.sums.size());
  to.add(std::uint64_t{result.batch_jobs});
  to.add(std::uint64_t{result.record_words});
  to.add(std::uint64_t{result.merged});
  to.add(std::uint64_t{result.batches.size()});
  for (const film::SplatRecords& batch : result.batches) to.add(Counts{batch.count, batch.paths});
  for (const film::SplatRecords& batch : result.batches)
    for (std::size_t array = 0; array < result.record_words; ++array)
      to.add_array(batch.words + array * batch.capacity, batch.count);
}

render::LaunchResult take_result(const Message& message, Unpacker& from) {
  render::LaunchResult result;
  result.launch = from.take<render::Launch>();
  result.rays = from.take<std::uint64_t>();
  result.shadow_rays = from.take<std::uint64_t>();
  const auto sums = from.take<std::uint64_t>();
  if (const auto* const values = from.take_array<film::BlockSum>(sums)) result.sums = {values, values + sums};
  result.batch_jobs = from.take<std::uint64_t>();
  result.record_words = from.take<std::uint64_t>();
  result.merged = from.take<std::uint64_t>() != 0;
  const auto batches = from.take<std::uint64_t>();
  const Counts* const counts = from.take_array<Counts>(batches);
  for (std::size_t batch = 0; batch < batches && counts != nullptr; ++batch) {
    const auto [records, paths] = counts[batch];
    const std::size_t capacity = (records + 1) / 2 * 2; // arrays begin at multiples of 8 bytes
    result.batches.push_back({.words = from.take_array<float>(result.record_words * capacity),
                              .capacity = capacity,
                              .count = records,
                              .paths = paths});
  }
  result.memory = message.bytes;
  return result;
}

void add(const Failure& failure, Packer& to) {
  to.add(failure.text);
  to.add(std::array{failure.memory_is_short, failure.becomes_smaller, failure.for_good});
}

Failure take_failure(Unpacker& from) {
  Failure failure;
  failure.text = from.take_text();
  const auto flags = from.take<std::array<bool, 3>>();
  failure.memory_is_short = flags[0];
  failure.becomes_smaller = flags[1];
  failure.for_good = flags[2];
  return failure;
}

} // namespace phlux::cluster
