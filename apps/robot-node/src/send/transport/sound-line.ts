import type { RtpTransport } from './rtp-transport.ts';
import type { VoiceReceiver } from './voice-receiver.ts';

/** The m-line for sound, as it was negotiated with one operator. */
export interface SoundLine {
  /** `a=mid`. */
  mid: string;
  /** The robot's microphone; `null` if the operator refused the line. */
  transport: (RtpTransport & { sendReport(nowMs: number, clockRate: number): void }) | null;
  /** The operator's voice; `null` if the operator refused the line. */
  voice: VoiceReceiver | null;
}
