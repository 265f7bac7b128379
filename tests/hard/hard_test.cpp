#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "tests/hard/hard_case.h"

namespace lemma::test {
namespace {

/// The rows of all cases run, printed as one table at the end.
class Table : public testing::Environment {
 public:
  struct Row {
    HardCase hard_case;
    std::string_view backend;
    Outcome outcome;
    bool held_to_it;
  };
  static void add(const Row& row) { rows().push_back(row); }

  void TearDown() override {
    std::printf("%-40s%-9s%-22s%8s%8s%9s\n", "case", "backend", "expected", "tried", "faults", "allowed");
    for (const Row& row : rows()) {
      std::printf("%-40s%-9s%-22s%8zu%8zu%9s\n", row.hard_case.name.data(), row.backend.data(),
                  row.hard_case.expected.data(), row.outcome.rays, row.outcome.faults,
                  row.held_to_it ? "0" : "shown");
    }
  }

 private:
  static std::vector<Row>& rows() {
    static std::vector<Row> rows;
    return rows;
  }
};

const auto* const kTable = testing::AddGlobalTestEnvironment(new Table);

class Hard : public testing::TestWithParam<std::tuple<HardCase, std::string_view>> {};

TEST_P(Hard, NoFaults) {
  const auto& [hard_case, backend] = GetParam();
  const Outcome outcome = hard_case.run(backend);
  const bool held_to_it = backend != "embree" || hard_case.embree_too;
  Table::add({hard_case, backend, outcome, held_to_it});
  EXPECT_GT(outcome.rays, 0u);
  if (held_to_it) {
    EXPECT_EQ(outcome.faults, 0u) << hard_case.name << ", " << backend;
  }
}

constexpr std::string_view kBackends[] = {"grid", "brute", "embree"};

/// Name and backend of a case as names of tests may be, so that --gtest_filter finds it:
/// 8_teapot_in_a_stadium_grid.
std::string test_name(const testing::TestParamInfo<Hard::ParamType>& info) {
  const auto& [hard_case, backend] = info.param;
  std::string name = std::string(hard_case.name).append("_").append(backend);
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Mesh, Hard,
                         testing::Combine(testing::ValuesIn(mesh_cases().begin(), mesh_cases().end()),
                                          testing::ValuesIn(kBackends)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Surface, Hard,
                         testing::Combine(testing::ValuesIn(surface_cases().begin(), surface_cases().end()),
                                          testing::ValuesIn(kBackends)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Transport, Hard,
                         testing::Combine(testing::ValuesIn(transport_cases().begin(),
                                                            transport_cases().end()),
                                          testing::ValuesIn(kBackends)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Sampling, Hard,
                         testing::Combine(testing::ValuesIn(sampling_cases().begin(), sampling_cases().end()),
                                          testing::Values(std::string_view("-"))),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Furnace, Hard,
                         testing::Combine(testing::ValuesIn(furnace_cases().begin(), furnace_cases().end()),
                                          testing::ValuesIn(kBackends)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Estimator, Hard,
                         testing::Combine(testing::ValuesIn(estimator_cases().begin(),
                                                            estimator_cases().end()),
                                          testing::Values(std::string_view("-"))),
                         test_name);

}  // namespace
}  // namespace lemma::test
