#include "guard.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>

_Thread_local struct guard *volatile active_guard __attribute__((tls_model("initial-exec"))) = NULL;

static struct sigaction previous;
static pthread_once_t once = PTHREAD_ONCE_INIT;
static int install_error = 0;

static void on_bus_error(int signal_number, siginfo_t *info, void *context) {
  struct guard *guard = active_guard;
  const uint8_t *address = (const uint8_t *)info->si_addr;
  if (guard != NULL && address >= guard->base && address < guard->base + guard->bytes) {
    guard->fault = address;
    siglongjmp(guard->escape, 1);
  }
  if ((previous.sa_flags & SA_SIGINFO) != 0 && previous.sa_sigaction != NULL) {
    previous.sa_sigaction(signal_number, info, context);
  } else if (previous.sa_handler != SIG_DFL && previous.sa_handler != SIG_IGN) {
    previous.sa_handler(signal_number);
  } else {
    /*
     * Returning runs the faulting instruction again, now without this handler: the process ends as it would have
     * without it.
     */
    sigaction(SIGBUS, &previous, NULL);
  }
}

static void install(void) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_sigaction = on_bus_error;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  if (sigaction(SIGBUS, &action, &previous) != 0) install_error = errno;
}

int guard_install(void) {
  pthread_once(&once, install);
  return install_error;
}
