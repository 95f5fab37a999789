/** Why this operator's microphone cannot be used. */
export type VoiceFailureReason =
  | 'refused' // the operator, or a policy of the browser, does not allow it
  | 'no-microphone'
  | 'in-use' // by another program
  | 'insecure' // the page was not loaded by HTTPS
  | 'failed';

/** Why this operator's microphone cannot be used, for programs and for the console. */
export interface VoiceFailure {
  /** For programs. */
  reason: VoiceFailureReason;
  /** For the console: the browser's own words. */
  detail: string;
}

const REASON_OF_NAME: Readonly<Record<string, VoiceFailureReason>> = {
  NotAllowedError: 'refused',
  SecurityError: 'refused',
  NotFoundError: 'no-microphone',
  OverconstrainedError: 'no-microphone',
  NotReadableError: 'in-use',
  AbortError: 'in-use',
  InsecureError: 'insecure',
};

/** @param error what the browser gave instead of a microphone */
export function voiceFailure(error: unknown): VoiceFailure {
  const named = error instanceof Error || error instanceof DOMException;
  return {
    reason: (named ? REASON_OF_NAME[error.name] : undefined) ?? 'failed',
    detail: named ? `${error.name}: ${error.message}` : String(error),
  };
}
