import type { RosFault } from '@farpoint/ros';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readRequestHeader, withRequestHeader } from './request-header.ts';
import { ServiceCalls } from './service-calls.ts';
import { cdr } from './testing/helpers.ts';

const CLIENT = 77n;
const REQUEST = cdr(1);
const mine = { guid: `0110${'0'.repeat(28)}`, userData: 'serviceid=1;' };
const fast = { guid: `010f${'0'.repeat(28)}`, userData: '' };

function bench() {
  const service = {
    readers: [mine],
    writers: [mine],
    otherTypes: [] as string[],
    takes: true,
    sent: [] as Uint8Array[],
    write(bytes: Uint8Array): boolean {
      if (this.takes) this.sent.push(bytes);
      return this.takes;
    },
  };
  const time = { ms: 0 };
  const calls = new ServiceCalls('/charge', CLIENT, service, () => time.ms);
  const said: string[] = [];
  const call = (name: string, withinMs = 5000) =>
    calls.call(REQUEST, withinMs).then(
      (reply) => void said.push(`${name} ${[...reply]}`),
      ({ code, message }: RosFault) => void said.push(`${name} ${code} ${message}`),
    );
  const reply = (sequence: bigint, message: Uint8Array, client = CLIENT) =>
    calls.take(withRequestHeader({ client, sequence }, message));
  return { service, time, calls, said, call, reply };
}

describe('calls of a service', () => {
  it('are told apart by their headers, in whatever order they are answered', async () => {
    const { service, said, call, reply, calls } = bench();
    const both = [call('a'), call('b')];
    expect(service.sent.map(readRequestHeader)).toEqual([
      { client: CLIENT, sequence: 1n },
      { client: CLIENT, sequence: 2n },
    ]);
    reply(2n, cdr(22));
    reply(1n, cdr(11));
    await Promise.all(both);
    expect(said).toEqual(['b 0,1,0,0,22', 'a 0,1,0,0,11']);
    expect(calls.open).toBe(0);
  });

  it('hear nothing that is for others, comes twice, or is no reply', async () => {
    const { said, call, reply, calls } = bench();
    const done = call('a');
    reply(1n, cdr(1), 78n);
    reply(2n, cdr(2));
    calls.take(cdr());
    calls.take(new Uint8Array());
    expect(calls.open).toBe(1);
    reply(1n, cdr(3));
    reply(1n, cdr(4));
    await done;
    expect(said).toEqual(['a 0,1,0,0,3']);
  });

  it('are not sent before the server both hears and can reply', async () => {
    const { service, said, call, reply, calls } = bench();
    service.writers = [];
    expect(calls.isReady).toBe(false);
    const done = call('a');
    reply(1n, cdr(9));
    calls.update();
    expect(service.sent).toEqual([]);
    service.writers = [mine];
    expect(calls.isReady).toBe(true);
    calls.update();
    calls.update();
    expect(service.sent).toHaveLength(1);
    reply(1n, cdr(1));
    await done;
    expect(said).toEqual(['a 0,1,0,0,1']);
  });

  it('fail at once without a server, and send nothing', async () => {
    const { service, said, call } = bench();
    service.readers = [];
    await call('none');
    service.otherTypes = ['std_srvs/srv/Empty_Request'];
    await call('other');
    expect(said).toEqual([
      'none unavailable /charge: there is no such service',
      'other wrong-type /charge: its server takes std_srvs/srv/Empty_Request',
    ]);
    expect(service.sent).toEqual([]);
  });

  it('send nothing that another vendor’s server would misread, and say what helps', async () => {
    const { service, said, call, calls } = bench();
    service.readers = [mine, fast];
    expect(calls.isReady).toBe(false);
    await call('a');
    expect(service.sent).toEqual([]);
    expect(said).toEqual([
      'a unsupported /charge: its server runs on Fast DDS without rmw_cyclonedds; start the server with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp',
    ]);
  });

  it('fail at once when their server has gone, and not while another remains that heard them', async () => {
    const { service, said, call, calls } = bench();
    const second = { ...mine, userData: 'serviceid=2;' };
    [service.readers, service.writers] = [
      [mine, second],
      [mine, second],
    ];
    const done = call('a');
    service.writers = [second];
    calls.update();
    expect(calls.open).toBe(1);
    // It was not there when it was called.
    service.writers = [{ ...mine, userData: 'serviceid=3;' }];
    calls.update();
    await done;
    expect(said).toEqual(['a lost /charge: its server has gone while it was called']);
  });

  it('end with their time, at the latest', async () => {
    const { said, call, calls, time } = bench();
    const done = call('a', 1500);
    time.ms = 1499;
    calls.update();
    expect(calls.open).toBe(1);
    time.ms = 1500;
    calls.update();
    await done;
    expect(said).toEqual(['a lost /charge: no answer within 1.5 s']);
  });

  it('are 64 at most, and none after the end', async () => {
    const { said, call, calls, service } = bench();
    const all = Array.from({ length: 64 }, (_, i) => call(`${i}`));
    await call('more');
    expect(said).toEqual(['more refused /charge: 64 calls wait for an answer']);
    calls.close();
    await Promise.all(all);
    await call('late');
    expect(said).toHaveLength(66);
    expect(said.slice(1).every((each) => each.endsWith('the graph is closed'))).toBe(true);
    expect(service.sent).toHaveLength(64);
  });

  it('fail where DDS does not take them', async () => {
    const { service, said, call } = bench();
    service.takes = false;
    await call('a');
    expect(said[0]).toContain('a refused');
  });

  it('keep no more of a reply than a bound', async () => {
    const { calls, reply } = bench();
    const done = calls.call(REQUEST, 5000);
    reply(1n, Uint8Array.of(...cdr(), ...new Uint8Array(100_000)));
    expect(await done).toHaveLength(4 + 65_536);
  });

  it('are not disturbed by whatever comes', () => {
    const { calls, call } = bench();
    void call('a');
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 60 }), (bytes) => {
        calls.take(bytes);
        expect(calls.open).toBe(1);
      }),
    );
    calls.close();
  });
});
