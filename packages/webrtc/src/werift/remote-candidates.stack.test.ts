import { eventually } from '@farpoint/service/testing/eventually';
import { describe, expect, it, onTestFinished } from 'vitest';
import { RTCPeerConnection } from 'werift';
import type { CandidateRefusal } from '../ice/candidate-gate.ts';
import { guardConnection } from './guard-connection.ts';
import { RemoteCandidates } from './remote-candidates.ts';

/** As sent by a peer that hides its addresses; nothing can resolve these names. */
const HIDDEN = [
  'candidate:0 1 UDP 2122252543 7e1b2c1a-0000-4000-8000-00000000000a.local 40001 typ host',
  'candidate:4 1 TCP 2105524479 7e1b2c1a-0000-4000-8000-00000000000a.local 9 typ host tcptype active',
  '',
];

function peer() {
  const connection = new RTCPeerConnection({ iceServers: [], iceUseTcp: false, bundlePolicy: 'max-bundle' });
  guardConnection(connection);
  onTestFinished(() => connection.close());
  const refused: CandidateRefusal[] = [];
  const remote = new RemoteCandidates(connection, (reason) => refused.push(reason));
  return { connection, remote, refused };
}

const withoutCandidates = (sdp = '') => sdp.replaceAll(/a=(candidate:.*|end-of-candidates)\r\n/g, '');

async function connected(connection: RTCPeerConnection): Promise<void> {
  await eventually(() => /^(?:connected|failed)$/.test(connection.connectionState));
  expect(connection.connectionState).toBe('connected');
}

describe('RemoteCandidates', () => {
  // Look-ups take ten seconds, longer than a test may take.
  for (const hides of ['offerer', 'answerer'] as const) {
    it(`connects to a hidden ${hides} while its names are being looked up`, async () => {
      const [offerer, answerer] = [peer(), peer()];
      offerer.connection.addTransceiver('video', { direction: 'sendonly' });
      const [hidden, seen] = hides === 'offerer' ? [offerer, answerer] : [answerer, offerer];
      seen.connection.onIceCandidate.subscribe((candidate) => {
        if (candidate !== undefined) hidden.remote.add(candidate.toJSON());
      });
      await offerer.connection.setLocalDescription(await offerer.connection.createOffer());
      const offered = answerer.remote.describe(
        'offer',
        withoutCandidates(offerer.connection.localDescription?.sdp),
      );
      if (hides === 'offerer')
        for (const candidate of HIDDEN) seen.remote.add({ candidate, sdpMLineIndex: 0 });
      await offered;
      await answerer.connection.setLocalDescription(await answerer.connection.createAnswer());
      const answered = offerer.remote.describe(
        'answer',
        withoutCandidates(answerer.connection.localDescription?.sdp),
      );
      if (hides === 'answerer')
        for (const candidate of HIDDEN) seen.remote.add({ candidate, sdpMLineIndex: 0 });
      await answered;
      await Promise.all([connected(offerer.connection), connected(answerer.connection)]);
      expect(seen.refused).toEqual(['not-udp']);
    });
  }

  it('survives a port 5353 that cannot be used', async () => {
    const [offerer, answerer] = [peer(), peer()];
    offerer.connection.addTransceiver('video', { direction: 'sendonly' });
    await offerer.connection.setLocalDescription(await offerer.connection.createOffer());
    await answerer.remote.describe('offer', offerer.connection.localDescription?.sdp ?? '');
    for (const candidate of HIDDEN) answerer.remote.add({ candidate, sdpMLineIndex: 0 });
    const lookups = answerer.connection.iceTransports.map(
      ({ connection }) =>
        (connection as unknown as { lookup?: { mdnsInstance: NodeJS.EventEmitter } }).lookup?.mdnsInstance,
    );
    const [mdns] = lookups.filter((one) => one !== undefined);
    expect(mdns?.emit('error', new Error('bind EADDRINUSE 0.0.0.0:5353'))).toBe(true);
  });
});
