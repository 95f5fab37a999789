import { loadSend, type Send } from './addon.ts';

/** What systemd gave a service to be told by: sd_notify(3), sd_watchdog_enabled(3). */
export interface NotifyOrder {
  socket: string;
  /** Without a word for this long systemd kills the service, ms; `null` where it does not watch. */
  watchdogMs: number | null;
}

/** @returns `null` where nobody waits for a word: not under systemd, or a unit that is not of `Type=notify` */
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

/** Tells systemd how the service is. */
export class Notifier {
  readonly #order: NotifyOrder;
  readonly #send: Send;
  #beat: NodeJS.Timeout | null = null;
  /** Words that the socket did not take. */
  failed = 0;

  constructor(order: NotifyOrder, send: Send = loadSend()) {
    this.#order = order;
    this.#send = send;
  }

  /** The service will be up within `mostMs`, ms: systemd waits for that long. */
  starting(mostMs: number): void {
    this.#tell(`EXTEND_TIMEOUT_USEC=${Math.ceil(mostMs * 1000)}`);
  }

  /** The service is up. From here on systemd hears of it twice in each watchdog time, while `isAlive` says so. */
  ready(isAlive: () => boolean, status: () => string): void {
    this.#tell(`READY=1\nSTATUS=${status()}`);
    const { watchdogMs } = this.#order;
    if (watchdogMs === null) return;
    this.#beat = setInterval(() => {
      if (isAlive()) this.#tell(`WATCHDOG=1\nSTATUS=${status()}`);
    }, watchdogMs / 2);
    this.#beat.unref();
  }

  /** The service is on its way out. */
  stopping(): void {
    if (this.#beat !== null) clearInterval(this.#beat);
    this.#beat = null;
    this.#tell('STOPPING=1');
  }

  #tell(message: string): void {
    if (this.#send(this.#order.socket, message) !== 0) this.failed++;
  }
}
