import { expect, test } from 'vitest';
import { fleetingPlace } from './state-place.ts';

const NAMELESS = 'f'.repeat(64);
const DOCKER = `610 520 0:52 / / rw,relatime master:300 - overlay overlay rw,lowerdir=/a:/b
611 610 0:55 / /proc rw - proc proc rw
612 610 0:56 / /tmp rw - tmpfs tmpfs rw
620 610 8:1 /var/lib/farpoint /var/lib/farpoint rw,relatime - ext4 /dev/sda1 rw
621 610 8:1 /var/lib/docker/volumes/kept/_data /named rw - ext4 /dev/sda1 rw
622 610 8:1 /var/lib/docker/volumes/${NAMELESS}/_data /nameless rw - ext4 /dev/sda1 rw
623 610 8:1 /x /with\\040space rw - ext4 /dev/sda1 rw
`;
const MACHINE = `22 1 8:2 / / rw,relatime shared:1 - ext4 /dev/sda2 rw
24 22 0:21 / /run rw,nosuid shared:5 - tmpfs tmpfs rw
`;

test.each([
  ['/.local/state/farpoint', 'layer'],
  ['/var/lib', 'layer'],
  ['/var/lib/farpointer', 'layer'],
  ['/var/lib/farpoint', null],
  ['/var/lib/farpoint/deeper', null],
  ['/tmp/farpoint', 'memory'],
  ['/named', null],
  ['/nameless/farpoint', 'volume'],
  ['/with space/farpoint', null],
])('in a container, %s: %j', (path, fleeting) => {
  expect(fleetingPlace(DOCKER, path, true)).toBe(fleeting);
});

test.each([
  ['/var/lib/farpoint', null],
  ['/run/farpoint', 'memory'],
])('on a machine, %s: %j', (path, fleeting) => {
  expect(fleetingPlace(MACHINE, path, false)).toBe(fleeting);
});

test('a container is known by its engine’s mark, too, and a layer by its file system', () => {
  expect(fleetingPlace(MACHINE, '/var/lib/farpoint', true)).toBe('layer');
  expect(fleetingPlace(DOCKER, '/var/lib', false)).toBe('layer');
});

test('of two mounts on one place, the later one counts; nonsense says nothing', () => {
  const hidden = `${DOCKER}630 610 0:60 / /named rw - tmpfs tmpfs rw\n`;
  expect(fleetingPlace(hidden, '/named', true)).toBe('memory');
  expect(fleetingPlace('nonsense\n1 2 3 - \n', '/named', true)).toBeNull();
});
