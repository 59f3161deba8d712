#include "engine/app/commands/results.hpp"

#include "engine/app/result/paper_tables.hpp"
#include "engine/app/result/result_json.hpp"
#include "engine/app/result/result_tables.hpp"

namespace torquescope {

void print_results(Session const& session, ResultSummary const& summary) {
  session.note("\n");
  session.result(warning_lines(summary, session.result_ink()));
  session.result(result_table(summary, session.result_ink()));
  session.result(paper_tables(summary, session.result_ink()));
  session.document(result_json(summary));
}

}  // namespace torquescope
