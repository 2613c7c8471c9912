// Tables of method results. A row begins with a key that identifies the scene, then the method; it ends with
// the fingerprint of the settings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/common/methods/ranking.h"
#include "bench/common/methods/reference.h"
#include "bench/common/tables/saved_table.h"

namespace phlux::bench {

class ResultTable {
public:
  using Values = std::vector<std::string>;

  /// Reads `folder`/`name` if it exists and has these columns: those of the key, integrator, strategy,
  /// connect_or_weights, `columns`, settings.
  ResultTable(const std::filesystem::path& folder, const std::string& name, const Values& key_columns,
              const Values& columns);

  [[nodiscard]] bool empty() const { return table_.rows().empty(); }
  /// Whether every one of the `methods` has a row of this key and these settings.
  [[nodiscard]] bool has(const Values& key, const std::vector<Method>& methods,
                         const std::string& settings) const;
  /// `methods`, and others that have rows of this key and these settings. Methods are only comparable within
  /// one measurement: those that were measured earlier must be measured again with the new ones.
  [[nodiscard]] std::vector<Method> with_earlier(const Values& key, std::vector<Method> methods,
                                                 const std::string& settings) const;
  /// Removes the rows of this key.
  void remove(const Values& key);
  void add(const Values& key, const Method& method, const Values& values, const std::string& settings);
  /// Replaces the file atomically. @throws WriteError
  void write() const { table_.write(); }

private:
  [[nodiscard]] bool is_of(const SavedTable::Row& row, const Values& key) const;
  [[nodiscard]] Method method_of(const SavedTable::Row& row) const;

  SavedTable table_;
  std::size_t key_size_;
};

/// Values that are the same in all rows.
struct CommonValues {
  std::string device;
  int lanes = 0;
  std::uint64_t seed = 0;
  CostClock clock = CostClock::wall;
};

/// From `device` on, the fixed columns, then those about the measurement. Values that the verdict
/// does not allow are empty (bench/README.md).
[[nodiscard]] const std::vector<std::string>& result_columns();
[[nodiscard]] std::vector<std::string> result_values(const MethodResult& result, const RankedCost& cost,
                                                     const ReferenceImage& reference,
                                                     const scene::Camera& camera, const CommonValues& common);

/// Six digits; empty if not finite.
[[nodiscard]] std::string number_text(double value);

} // namespace phlux::bench
