// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "quadrille/core/progress.hpp"

namespace quadrille::python {

namespace py = pybind11;

/// One search and what Python wants of it meanwhile. The search has a thread of its own that never
/// asks for the GIL. The calling thread waits without the GIL, and takes it to look for signals and
/// to call back: so Ctrl-C is heard at once, whatever the search is doing, callbacks run in the
/// thread that called, and a slow callback does not slow the search down.
template <class Plan>
class Conversation {
 public:
  /// Either function may be empty. They are called with the GIL.
  Conversation(std::function<void(const Progress&)> on_progress,
               std::function<void(const Plan&)> on_plan)
      : on_progress_(std::move(on_progress)), on_plan_(std::move(on_plan)) {}

  /// For Limits::interrupt.
  [[nodiscard]] const std::atomic<bool>& interrupt() const noexcept { return interrupt_; }
  /// Ctrl-C was heard, perhaps as the search ended for another reason.
  [[nodiscard]] bool was_interrupted() const noexcept { return interrupt_; }
  /// To be called by the search. What has not been passed on is replaced by what is newer.
  void tell(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    news_.notify_one();
  }
  void tell(const Plan& plan) {
    const std::lock_guard lock(mutex_);
    plan_ = plan;
    news_.notify_one();
  }

  /// What `search` returns. KeyboardInterrupt ends the search, and what there is by then is
  /// returned; any other exception, of a callback or of a signal handler, ends it and is rethrown.
  /// To be called with the GIL.
  template <class Search>
  auto run(const Search& search) {
    std::optional<decltype(search())> answer;
    std::exception_ptr failure;
    std::thread thread([&] {
      try {
        answer.emplace(search());
      } catch (...) {
        failure = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      done_ = true;
      news_.notify_one();
    });
    while (wait()) attend();
    {
      const py::gil_scoped_release release;
      thread.join();
    }
    attend();
    if (refusal_) std::rethrow_exception(refusal_);
    if (failure) std::rethrow_exception(failure);
    return *std::move(answer);
  }

 private:
  /// Until there is something to do. False when the search has ended.
  bool wait() {
    // Signals come without a notice.
    constexpr std::chrono::milliseconds kLook(20);
    const py::gil_scoped_release release;
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, kLook, [this] { return done_ || progress_ || plan_; });
    return !done_;
  }

  void attend() {
    std::optional<Progress> progress;
    std::optional<Plan> plan;
    {
      const std::lock_guard lock(mutex_);
      progress.swap(progress_);
      plan.swap(plan_);
    }
    if (refusal_) return;
    try {
      look_for_signals();
      if (progress && on_progress_) on_progress_(*progress);
      if (plan && on_plan_) on_plan_(*plan);
    } catch (py::error_already_set& error) {
      // Ctrl-C may as well come while a callback runs.
      if (!error.matches(PyExc_KeyboardInterrupt)) refusal_ = std::current_exception();
      interrupt_ = true;
    } catch (...) {
      refusal_ = std::current_exception();
      interrupt_ = true;
    }
  }

  static void look_for_signals() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

  const std::function<void(const Progress&)> on_progress_;
  const std::function<void(const Plan&)> on_plan_;
  std::atomic<bool> interrupt_{false};
  std::exception_ptr refusal_;  // What a callback or a signal handler has thrown.
  std::mutex mutex_;
  std::condition_variable news_;
  // Guarded by the mutex.
  std::optional<Progress> progress_;
  std::optional<Plan> plan_;
  bool done_ = false;
};

}  // namespace quadrille::python
