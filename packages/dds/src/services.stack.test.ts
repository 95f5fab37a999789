/** Services over real DDS: against a stand-in for a node on rmw_cyclonedds with an encoder of its own, and against Fast DDS. */
import {
  type RosFault,
  readStdServiceReply,
  type ServiceClient,
  type ServiceType,
  stdServiceRequest,
  stdServiceTypes,
} from '@farpoint/ros';
import { eventually } from '@farpoint/service/testing/eventually';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { isAvailable } from './addon.ts';
import { DdsGraph } from './dds-graph.ts';
import { ADDON_SUITE, testDomain } from './testing/helpers.ts';
import { findPeer, PEER_REMEDY, Peer } from './testing/peers.ts';
import { findServicePeer, ServicePeer, type ServicePeerOptions } from './testing/service-peer.ts';

const domain = testDomain();
const CHARGE = '/charge';
const TRIGGER = 'std_srvs/Trigger';
/** Longer than any of these tests. */
const LONG_MS = 600_000;
const python = isAvailable() ? findServicePeer() : null;
const fast = isAvailable() ? findPeer('Fast DDS') : null;
const noteOf = (kind: 'Python' | 'Fast DDS') =>
  ADDON_SUITE.skip ? ADDON_SUITE.note : `needs ${PEER_REMEDY[kind]}`;

let graph: DdsGraph;
let peers: { kill(): Promise<void> }[];
beforeEach(() => {
  peers = [];
  if (isAvailable()) graph = new DdsGraph({ domain, localhostOnly: true, env: {} });
});
afterEach(async () => {
  await graph?.close();
  for (const peer of peers) await peer.kill();
});

const clientOf = (type: ServiceType, at = graph) =>
  at.serviceClient({ service: CHARGE, ...stdServiceTypes(type) });
const call = async (client: ServiceClient, type: ServiceType = TRIGGER, data = false) =>
  readStdServiceReply(type, await client.call(stdServiceRequest(type, data), LONG_MS));
const outcomeOf = <Reply>(reply: Promise<Reply>) => reply.catch((error: RosFault) => error);
/** How a call ends that is repeated while there is no service: discovery takes its time. */
const onceThere = (client: ServiceClient, type: ServiceType = TRIGGER, data = false) =>
  eventually(async () => {
    const outcome = await outcomeOf(call(client, type, data));
    return 'code' in outcome && outcome.code === 'unavailable' ? null : outcome;
  });

describe(`a service (${noteOf('Python')})`, { skip: python === null, timeout: 60_000 }, () => {
  const start = async (options: Omit<ServicePeerOptions, 'domain'> = {}) => {
    const peer = await ServicePeer.start(python as string[], { domain, service: CHARGE, ...options });
    peers.push(peer);
    return peer;
  };
  it.each([
    ['Empty', false, { structure_needs_at_least_one_member: 0 }, {}],
    ['Trigger', false, { structure_needs_at_least_one_member: 0 }, { success: true, message: 'docked, ü' }],
    ['SetBool', true, { data: true }, { success: true, message: '' }],
    ['SetBool', false, { data: false }, { success: false, message: 'no power' }],
  ] as const)('std_srvs/%s is called with %s, and answers', async (name, data, asked, answer) => {
    const type = `std_srvs/${name}` as const;
    const client = clientOf(type);
    const peer = await start({ type: name });
    const reply = onceThere(client, type, data);
    expect((await peer.request(CHARGE)).fields).toEqual(asked);
    peer.do({ do: 'reply', to: 0, fields: answer });
    expect(await reply).toEqual({ success: true, message: '', ...answer });
  });

  it('replies to two clients at once, each of which hears its own reply only', async () => {
    const other = new DdsGraph({ domain, localhostOnly: true, env: {} });
    peers.push({ kill: () => other.close() });
    const clients = [clientOf(TRIGGER), clientOf(TRIGGER, other)] as const;
    const peer = await start();
    const replies = [onceThere(clients[0])];
    const a = await peer.request(CHARGE);
    replies.push(onceThere(clients[1]));
    const b = await peer.request(CHARGE, 2);
    expect(a.client).not.toBe(b.client);
    peer.do({ do: 'reply', to: 1, fields: { success: true, message: 'b' } });
    peer.do({ do: 'reply', to: 0, fields: { success: true, message: 'a' } });
    expect(await Promise.all(replies)).toMatchObject([{ message: 'a' }, { message: 'b' }]);
  });

  it('is not heard with another header', async () => {
    const client = clientOf(TRIGGER);
    const peer = await start();
    const reply = onceThere(client);
    await peer.request(CHARGE);
    peer.do({ do: 'reply', to: 0, client: 1, fields: { success: true, message: 'of another client' } });
    peer.do({ do: 'reply', to: 0, sequence: 1, fields: { success: true, message: 'of another request' } });
    peer.do({ do: 'reply', to: 0, fields: { success: true, message: 'ours' } });
    expect((await reply).message).toBe('ours');
  });

  it('that vanishes while it is called has failed at once', async () => {
    const client = clientOf(TRIGGER);
    const peer = await start();
    const fault = onceThere(client);
    await peer.request(CHARGE);
    peer.do({ do: 'vanish' });
    expect(await fault).toMatchObject({ code: 'lost', what: 'its server has gone while it was called' });
    expect(await outcomeOf(call(client))).toMatchObject({ code: 'unavailable' });
  });

  it('of a server without an identifier is refused, and hears nothing', async () => {
    const client = clientOf(TRIGGER);
    const peer = await start({ identifier: 'no' });
    expect(await onceThere(client)).toMatchObject({
      code: 'unsupported',
      message: expect.stringContaining('RMW_IMPLEMENTATION=rmw_cyclonedds_cpp'),
    });
    expect(peer.requests).toEqual([]);
  });

  it('of another type is named', async () => {
    const client = clientOf(TRIGGER);
    await start({ type: 'Empty' });
    expect(await onceThere(client)).toMatchObject({
      code: 'wrong-type',
      what: 'its server takes std_srvs/srv/Empty_Request',
    });
  });
});

describe(`a service on Fast DDS (${noteOf('Fast DDS')})`, { skip: fast === null, timeout: 60_000 }, () => {
  it('is refused, and hears nothing', async () => {
    const client = clientOf(TRIGGER);
    const peer = await Peer.start(fast as string[], {
      domain,
      heard: 'rq/chargeRequest',
      heardType: 'std_srvs::srv::dds_::Trigger_Request_',
      raw: 'rr/chargeReply',
      rawType: 'std_srvs::srv::dds_::Trigger_Response_',
    });
    peers.push(peer);
    expect(await onceThere(client)).toMatchObject({
      code: 'unsupported',
      what: 'its server runs on Fast DDS without rmw_cyclonedds',
    });
    expect(peer.heard).toBe(0);
  });
});

describe(`services (${ADDON_SUITE.note})`, { skip: ADDON_SUITE.skip }, () => {
  it('without a server fail at once, and with names that are none from the start', async () => {
    expect(await outcomeOf(call(clientOf(TRIGGER)))).toMatchObject({ code: 'unavailable' });
    const names = stdServiceTypes(TRIGGER);
    expect(() => graph.serviceClient({ service: 'charge', ...names })).toThrow(/not a complete name/);
    expect(() => graph.serviceClient({ service: CHARGE, request: 'x', reply: 'y' })).toThrow(/not types/);
  });

  it('end with their graph', async () => {
    const client = clientOf(TRIGGER);
    await graph.close();
    expect(await outcomeOf(call(client))).toMatchObject({ code: 'lost' });
  });
});
