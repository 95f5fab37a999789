import { describe, expect, it } from 'vitest';
import { devicesOf, judgeUnitDevices, unitDevices } from './check-unit.ts';

const CHIP = '/dev/gpiochip0';
const OLD = 'LoadState=loaded\nPrivateDevices=yes\nDevicePolicy=auto\n';
const NEW =
  'LoadState=loaded\nPrivateDevices=no\nDevicePolicy=closed\nDeviceAllow=char-gpiochip r\nDeviceAllow=char-alsa rw\n';

describe('the service’s unit', () => {
  it('that hides the devices is named, with the chip that the robot could not open, and the remedy', () => {
    expect(judgeUnitDevices([CHIP], unitDevices(OLD))).toEqual([
      {
        verdict: 'fail',
        detail: `as a service the robot cannot open ${CHIP}: its unit hides the machine’s devices (PrivateDevices=yes)`,
        remedy: expect.stringContaining('DeviceAllow=char-gpiochip rw') as string,
      },
    ]);
  });

  it.each<[string, string, boolean]>([
    ['permits the class', NEW, true],
    ['permits the device', 'DevicePolicy=strict\nDeviceAllow=/dev/gpiochip0 r\n', true],
    ['permits all classes', 'DevicePolicy=closed\nDeviceAllow=char-* rw\n', true],
    ['restricts nothing', 'PrivateDevices=no\nDevicePolicy=auto\nDeviceAllow=\n', true],
    ['is closed', 'PrivateDevices=no\nDevicePolicy=closed\n', false],
    [
      'permits others only',
      'DevicePolicy=auto\nDeviceAllow=char-alsa rw\nDeviceAllow=/dev/gpiochip1 r\n',
      false,
    ],
    ['hides what it permits', 'PrivateDevices=yes\nDeviceAllow=char-gpiochip r\n', false],
  ])('%s', (_, text, isWell) => {
    const found = judgeUnitDevices([CHIP], unitDevices(text));
    expect(found.map(({ verdict }) => verdict)).toEqual(isWell ? [] : ['fail']);
  });

  it('that does not exist forbids nothing', () => {
    expect(judgeUnitDevices([CHIP], null)).toEqual([]);
  });

  it('is asked for the devices that options name', () => {
    const none = { stops: { key: false }, sound: { kbitPerS: 32 }, videos: [] };
    expect(devicesOf(none)).toEqual([]);
    const gpio = { chip: CHIP, line: 4, activeLow: false };
    const loudspeaker = { sink: { kind: 'alsa' as const, device: 'default' } };
    expect(
      devicesOf({ ...none, stops: { key: false, gpio }, sound: { ...none.sound, loudspeaker } }),
    ).toEqual([CHIP, '/dev/snd']);
    expect(judgeUnitDevices([CHIP, '/dev/snd', '/dev/video0'], unitDevices(NEW))).toMatchObject([
      { detail: expect.stringContaining('/dev/video0') as string },
    ]);
  });
});
