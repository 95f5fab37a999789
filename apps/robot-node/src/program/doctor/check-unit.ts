/**
 * Checks whether the service's unit lets the robot open the devices that its options name. The doctor itself does not run
 * under the unit, and could open them.
 */
import { execFile } from 'node:child_process';
import type { RobotOptions } from '../robot-configuration.ts';
import { fail, type Result } from './finding.ts';

const UNIT = 'farpoint-robot';

/** What a unit permits. */
export interface UnitDevices {
  /** Whether it has a /dev of its own, without the machine's devices. */
  isPrivate: boolean;
  /** Paths and classes (`char-alsa`) that it permits; `null` if it permits all. */
  allowed: readonly string[] | null;
}

/** The kernel's names for the kinds of devices that options name (/proc/devices). */
const CLASSES: readonly (readonly [prefix: string, name: string])[] = [
  ['/dev/gpiochip', 'char-gpiochip'],
  ['/dev/snd', 'char-alsa'],
  ['/dev/video', 'char-video4linux'],
  ['/dev/v4l', 'char-video4linux'],
];

/** The devices that the robot opens by itself. */
export function devicesOf({
  stops,
  sound,
  videos,
}: Pick<RobotOptions, 'stops' | 'sound' | 'videos'>): string[] {
  const devices = videos.flatMap(({ source }) => (source.kind === 'v4l2' ? [source.device] : []));
  if (stops.gpio !== undefined) devices.unshift(stops.gpio.chip);
  const { microphone, loudspeaker } = sound;
  if (microphone?.source.kind === 'alsa' || loudspeaker?.sink.kind === 'alsa') devices.push('/dev/snd');
  return devices;
}

/** @param text of `systemctl show`; of a unit that sets nothing, nothing is forbidden */
export function unitDevices(text: string): UnitDevices {
  const values = (key: string) =>
    text
      .split('\n')
      .filter((line) => line.startsWith(`${key}=`))
      .map((line) => line.slice(key.length + 1));
  const allowed = values('DeviceAllow').flatMap((value) => value.split(' ')[0] || []);
  const [policy = 'auto'] = values('DevicePolicy');
  return {
    isPrivate: values('PrivateDevices').includes('yes'),
    allowed: policy === 'auto' && allowed.length === 0 ? null : allowed,
  };
}

/** @returns `null` if systemd does not run here, or has no such unit */
export function serviceUnit(withinMs: number): Promise<UnitDevices | null> {
  const properties = ['LoadState', 'PrivateDevices', 'DevicePolicy', 'DeviceAllow'];
  return new Promise((resolve) => {
    execFile(
      'systemctl',
      ['show', `${UNIT}.service`, ...properties.map((name) => `--property=${name}`)],
      { timeout: withinMs },
      (error, text) =>
        resolve(error === null && text.includes('LoadState=loaded') ? unitDevices(text) : null),
    );
  });
}

export function judgeUnitDevices(devices: readonly string[], unit: UnitDevices | null): Result[] {
  if (unit === null) return [];
  return devices.flatMap((device) => {
    const name = CLASSES.find(([prefix]) => device.startsWith(prefix))?.[1] ?? device;
    const isAllowed =
      unit.allowed === null || [device, name, 'char-*'].some((each) => unit.allowed?.includes(each));
    if (!unit.isPrivate && isAllowed) return [];
    const why = unit.isPrivate
      ? 'hides the machine’s devices (PrivateDevices=yes)'
      : 'does not permit it (DeviceAllow)';
    return [
      fail(
        `as a service the robot cannot open ${device}: its unit ${why}`,
        `run install.sh again for the unit of this version, or \`systemctl edit ${UNIT}\`: PrivateDevices=no, DeviceAllow=${name} rw`,
      ),
    ];
  });
}
