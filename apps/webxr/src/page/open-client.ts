/** The client of one robot, with what it knows of robots and of this browser's user. */
import { RobotClient, type RobotClientOptions, type TransformSupport } from '@farpoint/operator';
import { OperatorAccess } from '../ground/access/operator-access.ts';
import { browserAccess } from '../ground/access/stored-access.ts';
import { StoredRobots } from '../ground/access/stored-robots.ts';
import { LastPictures } from '../ground/pictures/last-pictures.ts';
import type { Settings } from '../ground/settings.ts';
import { tokenOrigin } from '../ground/signaling-tokens.ts';
import type { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import { videoReceiver } from '../take/video/video-receiver.ts';

export interface ClientParts {
  readonly settings: Settings;
  readonly transform: TransformSupport;
  readonly inputs: OperatorInputs;
  /** Of tests; default: WebRTC, or the bridge of the settings. */
  readonly openLink: RobotClientOptions['openLink'];
}

export function openClient({ settings, transform, inputs, openLink }: ClientParts) {
  const { signalingUrl, name, token, icePolicy, bridge } = settings;
  const receiver = videoReceiver(settings.videoReceiver);
  const origin = tokenOrigin(signalingUrl);
  const access = new OperatorAccess(browserAccess(origin), () => Date.now() / 1000);
  const knownRobots = new StoredRobots(origin);
  const client = new RobotClient({
    signalingUrl,
    name,
    token,
    icePolicy,
    transform,
    bridge,
    knownRobots,
    openLink,
    credentials: () => access.credentials(),
    inputs: inputs.all,
    ...(receiver?.adopt === undefined ? {} : { onVideoReceiver: receiver.adopt }),
  });
  const pictures = new LastPictures(origin, () => localStorage, Date.now());
  return { client, receiver, origin, access, knownRobots, pictures };
}
