import { expect, it } from 'vitest';
import { readMatched, serversOf } from './service-servers.ts';

const GUID = `0110${'0'.repeat(28)}`;
const server = (id: string, guid = GUID) => ({ guid, userData: `serviceid=${id};` });
const nobody = { whole: new Set(), replying: new Set(), isHeard: false, foreign: null };

it('a server is there once its reader and its writer are', () => {
  expect(serversOf([], [])).toEqual(nobody);
  expect(serversOf([server('1.2')], [])).toEqual({ ...nobody, isHeard: true });
  expect(serversOf([], [server('1.2')])).toEqual({ ...nobody, replying: new Set(['1.2']) });
  expect(serversOf([server('1.2')], [server('3')])).toMatchObject({ whole: new Set(), isHeard: true });
  expect(serversOf([server('1.2'), server('3')], [server('3'), server('1.2'), server('4')])).toEqual({
    whole: new Set(['1.2', '3']),
    replying: new Set(['3', '1.2', '4']),
    isHeard: true,
    foreign: null,
  });
});

it('its identifier may stand among other data', () => {
  const among = { guid: GUID, userData: 'typehash=RIHS01_0;serviceid=5.6;more=1;' };
  expect(serversOf([among], [server('5.6')]).whole).toEqual(new Set(['5.6']));
});

it.each([
  ['010f', 'Fast DDS'],
  ['0101', 'RTI Connext'],
  ['ffff', 'other software'],
])('one of other software (%s) has no identifier, and is named', (vendor, name) => {
  const foreign = { guid: `${vendor}${'0'.repeat(28)}`, userData: 'clientid=1;' };
  expect(serversOf([server('1'), foreign], [server('1')])).toMatchObject({ foreign: name });
  // Its replies are told by their header.
  expect(serversOf([server('1')], [server('1'), foreign])).toMatchObject({ foreign: null });
});

it('is read from pairs', () => {
  expect(readMatched(['a', 'b', 'c', ''])).toEqual([
    { guid: 'a', userData: 'b' },
    { guid: 'c', userData: '' },
  ]);
  expect(readMatched(['a'])).toEqual([]);
});
