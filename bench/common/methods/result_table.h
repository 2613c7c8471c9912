// Tables of method results. A row begins with a key that identifies the scene, then the method; it ends with
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

  /// Reads `folder`/`name` if it exists and has these columns: those of the key, integrator, strategy,
  /// connect_or_weights, `columns`, settings.
  ResultTable(const std::filesystem::path& folder, const std::string& name, const Values& key_columns,
              const Values& columns);

  [[nodiscard]] bool empty() const { return table_.rows().empty(); }
  /// The `methods` without a row of these settings. Refused ones count as missing too, since they take no
  /// time, but if all missing ones are refused, returns none.
  [[nodiscard]] std::vector<Method> missing(const Values& key, const std::vector<Method>& methods,
                                            const std::string& settings) const;
  /// Removes the rows of this key that are of other settings or of these methods.
  void remove(const Values& key, const std::vector<Method>& methods, const std::string& settings);
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
  bool processor_time = false; ///< variance_times_seconds uses processor time, not wall-clock time
};

/// From `device` on, the columns of the contract, then those about the measurement. Values that the verdict
/// does not allow are empty (bench/README.md).
[[nodiscard]] const std::vector<std::string>& result_columns();
[[nodiscard]] std::vector<std::string> result_values(const MethodResult& result,
                                                     const ReferenceImage& reference,
                                                     const scene::Camera& camera, const CommonValues& common);

/// Six digits; empty if not finite.
[[nodiscard]] std::string number_text(double value);

} // namespace phlux::bench
