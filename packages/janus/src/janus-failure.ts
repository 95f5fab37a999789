/** Why a request to Janus, or the connection, failed. */
export type JanusFailureReason =
  /** No WebSocket could be opened. */
  | 'unreachable'
  /** Janus did not answer in time. */
  | 'timeout'
  /** The WebSocket, or Janus' session, ended before the answer came. */
  | 'closed'
  /** Janus, not the plugin, refused the request; `code` is its own. */
  | 'refused'
  /** The streaming plugin has no such mountpoint. */
  | 'no-mountpoint'
  /** The admin key, the secret or the PIN is wrong. */
  | 'unauthorised'
  /** The streaming plugin refused the request for another reason; `code` is its own. */
  | 'plugin'
  /** The answer is not what Janus' documentation says. */
  | 'malformed';

export class JanusFailure extends Error {
  override readonly name = 'JanusFailure';
  readonly reason: JanusFailureReason;
  /** Janus' or the plugin's own number, if it gave one. */
  readonly code: number | null;

  /** @param detail for people; ends up in the message */
  constructor(reason: JanusFailureReason, detail: string, code: number | null = null) {
    super(detail);
    this.reason = reason;
    this.code = code;
  }
}

/** The plugin's error numbers (JANUS_STREAMING_ERROR_…) that mean something to us. */
const PLUGIN_REASONS: Readonly<Record<number, JanusFailureReason>> = {
  455: 'no-mountpoint',
  457: 'unauthorised',
};

export function pluginFailure(code: number, error: string): JanusFailure {
  return new JanusFailure(PLUGIN_REASONS[code] ?? 'plugin', error, code);
}
