import { createRequire } from 'node:module';
import { ADDON_FILE, BUILD_REMEDY } from './build.ts';

/** Sends one datagram to a Unix socket; returns 0, or an errno. */
export type Send = (socket: string, message: string) => number;

/** @throws {Error} if the addon is not built, with how to build it */
export function loadSend(): Send {
  try {
    return (createRequire(import.meta.url)(ADDON_FILE) as { notify: Send }).notify;
  } catch (error) {
    throw new Error(`the addon for systemd cannot be loaded: ${BUILD_REMEDY}`, { cause: error });
  }
}

/** What systemd expects a service to report, and where: sd_notify(3), sd_watchdog_enabled(3). */
export interface NotifyOrder {
  socket: string;
  /** Without a message for this long, systemd kills the service, ms; `null` without a watchdog. */
  watchdogMs: number | null;
}

/** @returns `null` if nobody expects messages: not under systemd, or a unit without `Type=notify` */
export function notifyOrder(
  env: Readonly<Record<string, string | undefined>>,
  pid: number,
): NotifyOrder | null {
  const socket = env.NOTIFY_SOCKET ?? '';
  if (!/^[/@]./.test(socket)) return null;
  const microseconds = Number(env.WATCHDOG_USEC ?? '');
  // The variable may be meant for the process that started us.
  const ours = env.WATCHDOG_PID === undefined || env.WATCHDOG_PID === String(pid);
  return { socket, watchdogMs: ours && microseconds > 0 ? microseconds / 1000 : null };
}

/** A new status is reported within this time, ms. */
const STATUS_MS = 1000;

/** Reports the service's state to systemd. */
export class Notifier {
  readonly #order: NotifyOrder;
  readonly #send: Send;
  readonly #timers: NodeJS.Timeout[] = [];
  #status = '';
  /** Messages that the socket did not accept. */
  failed = 0;

  constructor(order: NotifyOrder, send: Send = loadSend()) {
    this.#order = order;
    this.#send = send;
  }

  /** The service will be up within `mostMs`, ms; systemd waits that long. */
  starting(mostMs: number): void {
    this.#tell(`EXTEND_TIMEOUT_USEC=${Math.ceil(mostMs * 1000)}`);
  }

  /** The service is up. From now on, systemd gets a message twice per watchdog time, as long as `isAlive` holds. */
  ready(isAlive: () => boolean, status: () => string): void {
    this.#status = status();
    this.#tell(`READY=1\nSTATUS=${this.#status}`);
    this.#every(STATUS_MS, () => this.#tellStatus(status()));
    const { watchdogMs } = this.#order;
    if (watchdogMs === null) return;
    this.#every(watchdogMs / 2, () => {
      if (isAlive()) this.#tell('WATCHDOG=1');
    });
  }

  /** The service is shutting down. */
  stopping(): void {
    for (const timer of this.#timers.splice(0)) clearInterval(timer);
    this.#tell('STOPPING=1');
  }

  #every(ms: number, action: () => void): void {
    this.#timers.push(setInterval(action, ms).unref());
  }

  #tellStatus(status: string): void {
    if (status === this.#status) return;
    this.#status = status;
    this.#tell(`STATUS=${status}`);
  }

  #tell(message: string): void {
    if (this.#send(this.#order.socket, message) !== 0) this.failed++;
  }
}
