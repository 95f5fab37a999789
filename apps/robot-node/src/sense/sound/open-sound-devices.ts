import type { Logger } from '@farpoint/service';
import {
  Loudspeaker,
  type LoudspeakerOptions,
  Microphone,
  type MicrophoneOptions,
  type SoundFailure,
} from '@farpoint/sound';
import type { SoundDevices } from './sound-devices.ts';

/** A microphone and a loudspeaker, as far as there are any. */
export interface SoundOptions {
  /** `dtx`: sends less while it is quiet. */
  microphone?: Pick<MicrophoneOptions, 'source' | 'dtx'> | undefined;
  loudspeaker?: Pick<LoudspeakerOptions, 'sink'> | undefined;
  /** Of the microphone. */
  kbitPerS: number;
}

/** What the robot captures and plays with. Nothing is opened before it is needed. */
export function openSoundDevices(options: SoundOptions, log: Logger): SoundDevices {
  const { microphone, loudspeaker, kbitPerS } = options;
  const onLog = ({ level, msg }: { level: 'debug' | 'warn' | 'error'; msg: string }) =>
    log[level]({ from: 'farpoint-sound' }, msg);
  const failed = (onFault: (fault: string) => void) => {
    return ({ sentence, remedy, retried, reason }: SoundFailure) => {
      log.debug({ reason, retried, remedy }, sentence);
      onFault(`${sentence}; ${remedy}`);
    };
  };
  return {
    mostBitsPerSecond: kbitPerS * 1000,
    microphone:
      microphone === undefined
        ? null
        : (bitsPerS, { onPacket, onFault }) => {
            const { source, dtx } = microphone;
            const device = new Microphone({
              source,
              dtx,
              bitsPerS,
              onPacket,
              onLog,
              onFailure: failed(onFault),
            });
            return { configure: (bits) => device.configure(bits), close: () => device.close() };
          },
    loudspeaker:
      loudspeaker === undefined
        ? null
        : ({ onStarted, onFault }) =>
            new Loudspeaker({ sink: loudspeaker.sink, onStarted, onLog, onFailure: failed(onFault) }),
  };
}
