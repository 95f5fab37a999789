import { OptionsError } from '@farpoint/service';
import { expect, it } from 'vitest';
import { rosMasterUrl } from './ros.ts';

it('the ROS 1 master is the one named, else that of the environment, else this machine’s', () => {
  const env = { ROS_MASTER_URI: 'http://robot:11311' };
  expect(rosMasterUrl('http://other:1', env)).toBe('http://other:1');
  expect(rosMasterUrl(null, env)).toBe('http://robot:11311');
  expect(rosMasterUrl(null, { ROS_MASTER_URI: '' })).toBe('http://localhost:11311');
});

it.each(['robot:11311', 'robot', '10.0.0.2:11311', 'https://robot:11311', 'http://'])(
  'a variable that is no address is refused in words: %s',
  (uri) => {
    const read = () => rosMasterUrl(null, { ROS_MASTER_URI: uri });
    expect(read).toThrow(OptionsError);
    expect(read).toThrow(
      `ROS_MASTER_URI must be an http:// address, as in http://localhost:11311, not "${uri}"`,
    );
  },
);
