import type { Logger } from '@farpoint/service';
import { Loudspeaker, Microphone, type SoundFailure } from '@farpoint/sound';
import type { SoundOptions } from '../../program/options/sound.ts';
import type { SoundDevices } from './sound-devices.ts';

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
              ...{ source, dtx, bitsPerS, onPacket, onLog, onFailure: failed(onFault) },
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
