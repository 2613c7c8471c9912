// Tables of what methods gave: a row begins with what names the scene, its key, and the method, and ends with
// the fingerprint of the settings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/common/methods/scene_bench.h"
#include "bench/common/tables/saved_table.h"

namespace phlux::bench {

class ResultTable {
public:
  using Values = std::vector<std::string>;

  /// Reads `folder`/`name` where it is there with these columns: those of the key, integrator, strategy,
  /// connect_or_weights, then `columns`, then settings.
  ResultTable(const std::filesystem::path& folder, const std::string& name, const Values& key_columns,
              const Values& columns);

  [[nodiscard]] bool empty() const { return table_.rows().empty(); }
  /// Of `methods`, those without a row of these settings. Where they alone are missing that refused, which
  /// are asked again at no cost otherwise, none.
  [[nodiscard]] std::vector<Method> missing(const Values& key, const std::vector<Method>& methods,
                                            const std::string& settings) const;
  /// Removes what other settings gave, and what is measured anew.
  void forget(const Values& key, const std::vector<Method>& again, const std::string& settings);
  void add(const Values& key, const Method& method, const Values& values, const std::string& settings);
  /// Replaces the file, whole or not at all. @throws WriteError
  void write() const { table_.write(); }

private:
  [[nodiscard]] bool is_of(const SavedTable::Row& row, const Values& key) const;
  [[nodiscard]] Method method_of(const SavedTable::Row& row) const;

  SavedTable table_;
  std::size_t key_size_;
};

/// What the rows of a table have in common.
struct Measured {
  std::string device;
  int lanes = 0;
  std::uint64_t seed = 0;
  bool processor_time = false; ///< variance_times_seconds is of the processor's, not the wall clock's
};

/// From `device` on, the columns of the contract, then those that say how they were measured. A value that a
/// method has not earned is empty (README.md).
[[nodiscard]] const std::vector<std::string>& result_columns();
[[nodiscard]] std::vector<std::string> result_values(const MethodResult& result,
                                                     const ReferenceImage& reference,
                                                     const scene::Camera& camera, const Measured& measured);

/// Six digits; empty where it is not finite.
[[nodiscard]] std::string number_text(double value);

} // namespace phlux::bench
