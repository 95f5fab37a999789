/** What is said about the signaling service, the link to a robot, and losses of either. */
import type { SessionLoss, SignalingState } from '@farpoint/operator';

const STOPS = 'The robot stops by itself.';
const RETRIES = 'This page keeps trying; a STOP that you press now is kept for then.';

export const link = {
  starting: 'Starting…',
  signaling: {
    connecting: 'Connecting to the signaling service…',
    ready: 'Signaling connected',
    waiting: 'Cannot reach the signaling service. Trying again…',
    refused: 'The signaling service refused the token. Correct it in Settings.',
    stopped: 'Not connected to the signaling service',
  } satisfies Record<SignalingState, string>,
  /** Why the address of the signaling service cannot be used. */
  addressFault: (fault: string) => `Signaling address: ${fault}`,
  /** Why the last session ended. */
  loss: {
    'not-connected': 'Could not connect to the robot. Trying again…',
    'connection-failed': 'The connection to the robot was lost. The robot stops automatically. Trying again…',
    'closed-by-robot': 'The robot ended the session. Trying again…',
    'robot-restarted': 'The robot has restarted. Reconnecting…',
    'robot-stopped': 'The robot was shut down. Waiting for it to come back…',
    'robot-left': 'The robot went offline while connecting. Trying again…',
    'bad-answer':
      'The robot cannot use the connection that this browser offers. Update the browser or use another. Trying again…',
    'not-granted': 'The robot admits only operators with a grant that is valid for it.',
    'robot-key-changed': 'The robot’s key has changed: it may be another robot.',
    'robot-unproven': 'The robot did not prove that it is the one that this browser knows.',
    'grant-expired': 'Your grant for this robot has ended. Ask for another.',
    'grant-revoked': 'Your grant for this robot has been revoked.',
    'ended-by-supervisor': 'A supervisor has ended your session. Choose the robot to connect again.',
    'unproven-peer':
      'The robot refused the connection: it is not encrypted end to end with this page. Trying again…',
    'not-reading': 'This page could not keep up with the robot’s messages. Reconnecting…',
    unheard: 'The robot had not heard from this page for too long. Reconnecting…',
    silent: 'The robot does not respond. Trying again…',
    'signaling-lost': 'The signaling service was lost while connecting. Trying again…',
    refused: 'The signaling service did not open a session. Trying again…',
  } satisfies Record<Exclude<SessionLoss, 'robot-full'>, string>,
  /** @param who has ended the session, by the robot */
  endedBy: (who: string) => `${who}. Choose the robot to connect again.`,
  noPlace: (detail: string) => `The robot has no place for you: ${detail}. Trying again…`,
  full: 'The robot is full: it accepts no more operators. Trying again…',
  fullOf: (most: number) =>
    `The robot is full: it accepts ${most === 1 ? 'one operator' : `${most} operators`} at most. Trying again…`,
  offline: 'The robot is offline. Waiting for it to come back…',
  connecting: 'Connecting…',
  opening: 'Connecting to the robot…',
  lostFor: (seconds: number) => `Connection lost for ${seconds} s`,
  nothingComes: 'Nothing comes from the robot',
  noPoints: 'Connected, but no points are arriving.',
  liveWithoutSignaling: 'Live (signaling offline)',
  cautious: 'Live, at a cautious rate: the connection has no transport-wide feedback.',
  playback: 'Playback',
  live: 'Live',
  connectedTo: (robot: string) => `Connected to ${robot}`,
  grantEndsAndThen: (seconds: number) =>
    `Your grant ends in ${seconds} s. Then the robot stops and the session ends.`,
  grantEnds: (seconds: number) => `Your grant ends in ${seconds} s.`,
  robotReports: (message: string) => `The robot reports: ${message}`,
  /** The banner in the middle of the screen. */
  banner: {
    yours: 'Your connection is lost',
    yoursText: `Neither the robot nor the signaling service reaches this computer: check its network. ${STOPS} ${RETRIES}`,
    yoursAfter: (signaling: string) => `${STOPS} ${signaling}`,
    gone: 'The robot is gone',
    goneText: `Its program or its network is down: the signaling service does not see it, either. ${STOPS} This page connects again when it is back.`,
    silent: 'The robot does not answer',
    silentText: `The connection to it is lost. ${STOPS} ${RETRIES}`,
    deaf: 'The robot does not hear you',
    deafText: `You see it live, but nothing that you send arrives. ${STOPS} ${RETRIES}`,
    noService: 'No signaling service',
    notOnline: 'This robot is not online',
    notOnlineText: (robot: string) =>
      `The signaling service does not list “${robot}”. This page connects when it appears; to choose another robot, disconnect from this one.`,
    full: 'The robot is full',
    offline: 'The robot is offline',
    notConnected: 'Not connected',
  },
  /** Instead of a list of robots. @param host of the signaling service */
  noRobots: {
    ready: () => 'No robots are online. They appear here as soon as they connect to the signaling service.',
    refused: (host: string) =>
      `The signaling service at ${host} refused this page’s token, so it lists no robots. Enter the token in Settings, under Connection.`,
    waiting: (host: string) =>
      `The signaling service at ${host} cannot be reached, so no robots can be listed. Check the network, or the address in Settings. Trying again…`,
    connecting: (host: string) => `Asking the signaling service at ${host} for its robots…`,
    stopped: () => 'Not connected to a signaling service.',
  } satisfies Record<SignalingState, (host: string) => string>,
  /** A robot in the choice that is not listed. */
  offlineRobot: (robot: string) => `${robot} (offline)`,
};
