import type { IceServer } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import type { SignalingOptions } from '../../admit/signaling/signaling-client.ts';
import { makeRateController, type RateControlOptions } from '../../send/transport/make-rate-controller.ts';
import type { RobotSessionHost } from '../session/robot-session-host.ts';
import { ReferenceProfile, type ReferenceProfileOptions } from './reference-profile.ts';

interface ReferenceOptions extends RateControlOptions {
  /** The reference signaling service's port for robots; if undefined, the robot is not visible there. */
  referenceSignaling?: string | undefined;
  name: string;
  signaling: Pick<SignalingOptions, 'ca'>;
  iceServers: IceServer[];
}

type ReferenceProfileParts = Pick<ReferenceProfileOptions, 'packetLog' | 'sendLoop' | 'budgets'> & {
  peer: Omit<ReferenceProfileOptions['peer'], 'iceServers'>;
};

/** @returns `null` if the robot is not to be visible to the reference system's operators */
export function openReferenceProfile(
  options: ReferenceOptions,
  { peer, ...parts }: ReferenceProfileParts,
  host: RobotSessionHost,
  log: Logger,
): ReferenceProfile | null {
  const { referenceSignaling: url, name, signaling, iceServers } = options;
  if (url === undefined) return null;
  const makeController = () => makeRateController(options, true);
  const { ca } = signaling;
  return new ReferenceProfile(
    { url, ca, name, peer: { ...peer, iceServers }, makeController, ...parts },
    host,
    log,
  );
}
