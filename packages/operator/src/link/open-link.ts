import { knownInMemory } from '../access/known-robots.ts';
import { BridgeLink } from '../bridge/bridge-link.ts';
import type { RobotClientOptions } from '../client/client-options.ts';
import type { RobotLink, RobotLinkEvents } from './robot-link.ts';
import { WebRtcLink } from './webrtc-link.ts';

/** @param worker decodes the clouds */
export function openLink(options: RobotClientOptions, worker: Worker, events: RobotLinkEvents): RobotLink {
  if (options.openLink !== undefined) return options.openLink(worker, events);
  const { bridge = null, knownRobots = knownInMemory() } = options;
  return bridge === null
    ? new WebRtcLink({ ...options, worker, knownRobots }, events)
    : new BridgeLink(bridge, worker, events);
}
