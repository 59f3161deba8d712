#pragma once
// Reads what a diagnosis of many recordings left in a result: its verdict, its words as printed, its document.
//
// Errors     those of ResultReader; 65 where the verdict is no word of ours

#include <filesystem>
#include <string>

#include "engine/infer/verdict/diagnosis.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {

struct KeptServo {
  Verdict verdict = Verdict::insufficient;
  std::string verdict_text, text, json;
};

bool has_servo(ResultReader const& reader);
KeptServo read_servo(ResultReader const& reader);

}  // namespace torquescope
