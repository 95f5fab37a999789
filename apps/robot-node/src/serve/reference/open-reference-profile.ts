import type { Logger } from '@farpoint/service';
import type { RobotOptions } from '../../program/robot-configuration.ts';
import { makeRateController } from '../../send/transport/make-rate-controller.ts';
import type { RobotSessionHost } from '../session/robot-session-host.ts';
import { ReferenceProfile, type ReferenceProfileOptions } from './reference-profile.ts';

type ReferenceProfileParts = Pick<ReferenceProfileOptions, 'packetLog' | 'sendLoop' | 'onBudgetChanged'> & {
  peer: Omit<ReferenceProfileOptions['peer'], 'iceServers'>;
};

/** @returns `null` if the robot is not to be visible to the reference system's operators */
export function openReferenceProfile(
  options: RobotOptions,
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
