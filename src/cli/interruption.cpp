// SPDX-License-Identifier: Apache-2.0
#include "interruption.h"

#include <pthread.h>

#include <csignal>

namespace kiln {
namespace {

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

void end_by(int signal) {
  std::signal(signal, SIG_DFL);
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  std::raise(signal);
}

void listen(const std::stop_token& stop, std::atomic<int>& first) {
  const sigset_t set = stop_signals();
  while (true) {
    const int signal = sigwaitinfo(&set, nullptr);
    if (stop.stop_requested()) return;
    if (signal <= 0) continue;
    if (first != 0) end_by(signal);
    first = signal;
  }
}

}  // namespace

Interruption::Interruption() {
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  listener_ = std::jthread([this](const std::stop_token& stop) { listen(stop, signal_); });
}

Interruption::~Interruption() {
  listener_.request_stop();
  pthread_kill(listener_.native_handle(), SIGINT);  // wakes the listener, which then ends
  listener_.join();
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace kiln
