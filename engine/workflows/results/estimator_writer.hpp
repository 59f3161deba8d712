#pragma once
// Writes one estimator's runs into the result file: /runs/<label> (RESULT_FORMAT.md).
//
// Use        declare_histories(), then write_history() per run in order, then write_results()
// Errors     those of ResultWriter

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/effects/regressor.hpp"
#include "engine/experiment/estimator_plan.hpp"
#include "engine/experiment/job/stored_generations.hpp"
#include "engine/experiment/runs/run_part.hpp"
#include "engine/experiment/runs/run_summary.hpp"
#include "engine/experiment/runs/segment_file.hpp"
#include "engine/fit/problem/fitness_choice.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

// torque_unit: "N m" or "N"
void declare_histories(ResultWriter& writer, std::string const& label, HistoryShape const& shape,
                       StoredGenerations const& stored, std::string const& torque_unit);
// the writer may keep it for a while
void write_history(ResultWriter& writer, std::string const& label, std::size_t run,
                   std::shared_ptr<RunHistory const> const& history);
// of neighbouring runs from `first` on
void write_histories(ResultWriter& writer, std::string const& label, std::size_t first, StoredRuns const& runs);
// of every run its last generation, -1 where it has none: of histories with some generations only
void write_ends(ResultWriter& writer, std::string const& label, std::vector<std::int64_t> const& last_generations);
void write_results(ResultWriter& writer, EstimatorPlan const& plan, RunResults const& results,
                   std::string const& torque_unit, std::vector<std::string> const& parameters);

// the joint of the median run as code; nothing while runs are missing
void write_model_code(ResultWriter& writer, std::string const& label, Regressor const& regressor,
                      std::string const& torque_unit, RunResults const& results);

// what the fitness of a population method was made from, and why
void write_fitness_choice(ResultWriter& writer, std::string const& label, FitnessChoice const& choice);

// what only least squares has: errors, intervals, the equivalent form (nullptr: the model has none)
struct JointForm;
void write_least_squares(ResultWriter& writer, std::string const& label, LeastSquaresFit const& fit,
                         JointForm const* form);

// curves, surfaces and the path of every run on them; PC and FC: [run][generation that is stored]
void write_controller(ResultWriter& writer, std::string const& label, FuzzyController const& controller,
                      std::size_t runs, std::vector<double> const& PC, std::vector<double> const& FC);

}  // namespace torquescope
