import { parseClientMessage } from '@farpoint/foxglove/client-message';
import { readJwkSet, soleFingerprint } from '@farpoint/grants';
import { readJanusMessage } from '@farpoint/janus/message';
import {
  decodeBandwidth,
  decodeJson,
  decodeStreamSwitch,
  type JsonCodec,
  nearSectors,
  operatorControlCodec,
  operatorSessionCodec,
  operatorToServiceCodec,
  referenceClientToServiceCodec,
  referenceControlCodec,
  referencePageToBridgeCodec,
  referenceRobotToServiceCodec,
  referenceServiceToClientCodec,
  referenceServiceToRobotCodec,
  robotControlCodec,
  robotSessionCodec,
  robotToServiceCodec,
  serviceToOperatorCodec,
  serviceToRobotCodec,
  telemetryCodec,
  writeTile,
} from '@farpoint/protocol';
import { answerMisfit, sdpSections } from '@farpoint/reference-profile';
import type { FuzzTarget } from '../fuzz-target.ts';
import { vectors } from '../vectors.ts';

const text = (input: Uint8Array) => Buffer.from(input).toString();

function codec<T>(
  name: string,
  vectorsName: string | null,
  one: JsonCodec<T>,
  more: readonly string[] = [],
): FuzzTarget {
  return {
    name,
    seeds: () => [
      ...(vectorsName === null ? [] : vectors('protocol', vectorsName)),
      ...more.map((message) => Buffer.from(message)),
    ],
    run: (input) => void decodeJson(one, input),
    refusals: ['ProtocolError'],
  };
}

export const messageTargets: readonly FuzzTarget[] = [
  codec('operator-control', 'operator-control', operatorControlCodec),
  codec('operator-session', 'operator-session', operatorSessionCodec),
  codec('robot-session', 'robot-session', robotSessionCodec),
  {
    ...codec('telemetry', 'telemetry', telemetryCodec),
    run: (input) => {
      const message = decodeJson(telemetryCodec, input);
      if (message.type === 'nearField') nearSectors(message);
      if (message.type !== 'map') return;
      const cells = new Uint8Array(message.width * message.height);
      for (const [index, runs] of message.tiles) writeTile(message, index, runs, cells);
    },
  },
  codec('robot-control', 'robot-control', robotControlCodec),
  codec('robot-to-service', 'signaling-robot-to-service', robotToServiceCodec),
  codec('service-to-robot', 'signaling-service-to-robot', serviceToRobotCodec),
  codec('operator-to-service', 'signaling-operator-to-service', operatorToServiceCodec),
  codec('service-to-operator', 'signaling-service-to-operator', serviceToOperatorCodec),
  codec('reference-robot-to-service', 'reference-robot-to-service', referenceRobotToServiceCodec),
  codec('reference-client-to-service', 'reference-client-to-service', referenceClientToServiceCodec),
  codec('reference-service-to-robot', 'reference-service-to-robot', referenceServiceToRobotCodec),
  codec('reference-service-to-client', 'reference-service-to-client', referenceServiceToClientCodec),
  codec('reference-control', 'reference-control', referenceControlCodec),
  codec('reference-page-to-bridge', null, referencePageToBridgeCodec, [
    '{"type":"initBridge","signalingUrl":"ws://127.0.0.1:3002"}',
    '{"type":"switchRobot","robotId":1}',
    '{"type":"getRobots"}',
  ]),
  {
    name: 'bandwidth',
    seeds: () => vectors('protocol', 'bandwidth'),
    run: (input) => void decodeBandwidth(input),
    refusals: ['ProtocolError'],
  },
  {
    name: 'stream-switch',
    seeds: () => [Buffer.from('start'), Buffer.from('stop')],
    run: (input) => void decodeStreamSwitch(text(input)),
    refusals: ['ProtocolError'],
  },
  {
    name: 'janus-message',
    seeds: () => [
      Buffer.from('{"janus":"event","session_id":1,"sender":2,"plugindata":{"plugin":"p","data":{}}}'),
    ],
    run: (input) => void readJanusMessage(text(input)),
    refusals: [],
  },
  {
    name: 'foxglove-client',
    seeds: () => [
      Buffer.from('{"op":"subscribe","subscriptions":[{"id":0,"channelId":1}]}'),
      Buffer.from('{"op":"advertise"}'),
    ],
    run: (input) => {
      if ((input[0] ?? 0) % 16 === 1) parseClientMessage(input);
      else parseClientMessage(text(input));
    },
    refusals: ['ClientMessageError'],
  },
  {
    name: 'sdp-answer',
    seeds: () => [
      Buffer.from('v=0\r\nm=audio 9 UDP/TLS/RTP/SAVPF 111\r\na=mid:0\r\na=fingerprint:sha-256 AA:BB\r\n'),
    ],
    run: (input) => {
      sdpSections(text(input));
      answerMisfit('v=0\r\nm=audio 9 UDP/TLS/RTP/SAVPF 111\r\na=mid:0\r\n', text(input));
      soleFingerprint(text(input));
    },
    refusals: [],
  },
  {
    name: 'grant-keys',
    seeds: () => [
      Buffer.from(
        '{"keys":[{"kty":"OKP","crv":"Ed25519","x":"11qYAYKxCrfVS_7TyWQHOg7hcvPapiMlrwIaaPcHURo","kid":"k","alg":"EdDSA"}]}',
      ),
    ],
    run: (input) => void readJwkSet(text(input)),
    refusals: ['GrantKeysError'],
  },
];
