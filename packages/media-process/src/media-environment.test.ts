import fc from 'fast-check';
import { expect, it } from 'vitest';
import { mediaEnvironment } from './media-environment.ts';

it('passes on what GStreamer and its devices need', () => {
  const needed = {
    ...{ PATH: '/bin', HOME: '/home/ada', LC_ALL: 'C.UTF-8', XDG_RUNTIME_DIR: '/run/user/1' },
    ...{ GST_PLUGIN_PATH: '/gst', PULSE_SERVER: 'unix:/x', CUDA_VISIBLE_DEVICES: '0' },
  };
  expect(mediaEnvironment({ ...needed, FARPOINT_ROBOT_TOKEN: 'hunter2' })).toEqual(needed);
});

it('passes on nothing of ours, and no secret', () => {
  const named = fc.oneof(
    fc.string().map((name) => `FARPOINT_${name}`),
    fc.constantFrom(
      'AWS_SECRET_ACCESS_KEY',
      'GITHUB_TOKEN',
      'GST_RTSP_PASSWORD',
      'NOTIFY_SOCKET',
      'NODE_OPTIONS',
    ),
    fc
      .tuple(fc.constantFrom('GST_', 'XDG_'), fc.constantFrom('TOKEN', 'MY_SECRET'))
      .map((parts) => parts.join('')),
  );
  fc.assert(
    fc.property(named, (name) => {
      expect(mediaEnvironment({ [name]: 'hunter2' })).toEqual({});
    }),
  );
});
