#include "engine/app/commands/results.hpp"

#include "engine/app/commands/notes.hpp"
#include "engine/app/result/paper_tables.hpp"
#include "engine/app/result/result_json.hpp"
#include "engine/app/result/result_tables.hpp"
#include "engine/store/result_writer.hpp"
#include "engine/store/verification.hpp"

namespace torquescope {

ExitCode end_with_results(Session const& session, ResultSummary const& summary, std::string const& word,
                          std::filesystem::path const& file) {
  session.note("\n");
  session.result(warning_lines(summary, session.result_ink()));
  session.result(result_table(summary, session.result_ink()));
  session.result(paper_tables(summary, session.result_ink()));
  session.document(result_json(summary));
  note_whereabouts(session, word, file);
  return ExitCode::ok;
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
