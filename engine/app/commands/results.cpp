#include "engine/app/commands/results.hpp"

#include "engine/app/result/paper_tables.hpp"
#include "engine/app/result/result_json.hpp"
#include "engine/app/result/result_tables.hpp"
#include "engine/store/result_writer.hpp"
#include "engine/store/verification.hpp"

namespace torquescope {

void print_results(Session const& session, ResultSummary const& summary) {
  session.note("\n");
  session.result(warning_lines(summary, session.result_ink()));
  session.result(result_table(summary, session.result_ink()));
  session.result(paper_tables(summary, session.result_ink()));
  session.document(result_json(summary));
}

void verify_before_page(std::filesystem::path const& result) {
  // files of an earlier format have another digest, and Python looks first as well
  look_at_result(result, [](ResultReader const& reader) {
    refuse_columns(reader);
    if (reader.attribute<std::int64_t>("/", "format") >= first_format_of_this_digest)
      static_cast<void>(verify_everything(reader.name()));
  });
}

}  // namespace torquescope
