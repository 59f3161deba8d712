#include "engine/app/failure.hpp"

#include <fmt/format.h>

#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

Problem our_fault(std::string what) {
  Problem problem;
  problem.code = ExitCode::internal;
  problem.what = std::move(what);
  problem.help = "report it with the job file and this line; results so far are safe";
  return problem;
}

Problem out_of_memory() {
  Problem problem = our_fault("out of memory");
  problem.help = "fewer --threads, a smaller population or fewer generations need less";
  return problem;
}

// a thread or a process that does not start, where memory or their number is limited
bool is_a_limit(std::error_code const& code) {
  return code == std::errc::resource_unavailable_try_again || code == std::errc::not_enough_memory;
}

// "broken promise in /home/me/torquescope/engine/a.cpp:88: x < y" -> "broken promise in engine/a.cpp:88 (our fault)"
std::string promise_words(std::string const& text) {
  std::size_t begin = std::string::npos;
  for (char const* folder : {"/engine/", "/kernels/"})
    if (std::size_t const found = text.rfind(folder); found != std::string::npos) begin = found + 1;
  std::string const lead = "broken promise in ";
  std::string const place =
      begin == std::string::npos ? text.substr(std::min(lead.size(), text.size())) : text.substr(begin);
  std::size_t const condition = place.find(": ");
  std::string words = fmt::format("{}{} (our fault)", lead, place.substr(0, condition));
  if (condition != std::string::npos) words += place.substr(condition);
  return words;
}

}  // namespace

std::vector<Problem> problems_of(std::exception_ptr failure) {
  try {
    std::rethrow_exception(std::move(failure));
  } catch (Error const& error) {
    return error.problems();
  } catch (BrokenPromise const& broken) {
    return {our_fault(promise_words(broken.what()))};
  } catch (std::bad_alloc const&) {
    return {out_of_memory()};
  } catch (std::system_error const& error) {
    if (is_a_limit(error.code())) return {out_of_memory()};
    return {our_fault(fmt::format("unexpected: {} (our fault)", error.what()))};
  } catch (std::exception const& other) {
    return {our_fault(fmt::format("unexpected: {} (our fault)", other.what()))};
  } catch (...) {
    return {our_fault("unexpected failure (our fault)")};
  }
}

}  // namespace torquescope
