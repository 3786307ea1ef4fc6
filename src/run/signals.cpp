#include "run/signals.h"

#include <csignal>

namespace seiche {
namespace {

// Signal handlers may only write to variables of this type.
volatile std::sig_atomic_t received_signal = 0;

extern "C" void note_signal(int number) {
  received_signal = number;
}

void handle(int number, void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigaction(number, &action, nullptr);
}

}  // namespace

void note_stop_signals() {
  handle(SIGUSR1, note_signal, SA_RESTART);
  handle(SIGINT, note_signal, SA_RESTART | int(SA_RESETHAND));
  handle(SIGTERM, note_signal, SA_RESTART | int(SA_RESETHAND));
}

void restore_stop_signals() {
  for (const int number : {SIGUSR1, SIGINT, SIGTERM}) handle(number, SIG_DFL, 0);
  if (received_signal != 0) std::raise(received_signal);
}

int noted_signal() {
  return received_signal;
}

StopSignals::StopSignals() {
  if (received_signal == 0) note_stop_signals();
  handle(SIGXFSZ, SIG_IGN, 0);
}

StopSignals::~StopSignals() {
  // A late SIGUSR1 must not end a program that is finishing normally.
  handle(SIGUSR1, SIG_IGN, 0);
  handle(SIGINT, SIG_DFL, 0);
  handle(SIGTERM, SIG_DFL, 0);
  received_signal = 0;
}

int StopSignals::received() const {
  return received_signal;
}

std::string signal_name(int number) {
  switch (number) {
    case SIGUSR1:
      return "SIGUSR1";
    case SIGINT:
      return "SIGINT";
    case SIGTERM:
      return "SIGTERM";
    default:
      return "signal " + std::to_string(number);
  }
}

}  // namespace seiche
