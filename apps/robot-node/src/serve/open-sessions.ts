/** Operators' sessions, and what the robot's streams and its drive have to do with them. */
import { makeRateController, type RateControlOptions } from '../send/transport/make-rate-controller.ts';
import type { RobotStreams } from './robot-streams.ts';
import type { OperatorSession } from './session/operator-session.ts';
import { OperatorSessions, type OperatorSessionsOptions } from './session/operator-sessions.ts';
import type { PathKeeper } from './session/path-keeper.ts';
import type { RobotSessionHost } from './session/robot-session-host.ts';

type Given = Pick<
  OperatorSessionsOptions,
  'grants' | 'robotKey' | 'signaling' | 'counters' | 'audit' | 'commands' | 'stands' | 'packetLog' | 'log'
>;

export interface SessionsParts extends Given {
  peer: Omit<OperatorSessionsOptions['peer'], 'pictures'>;
  streams: RobotStreams;
  host: RobotSessionHost;
  paths: PathKeeper;
  /** Sends a session its first messages. */
  welcome: (operator: OperatorSession) => void;
}

export interface SessionsOptions
  extends Pick<OperatorSessionsOptions, 'id' | 'places' | 'watchersPoint' | 'iceServers'>,
    RateControlOptions {
  /** `share`: the largest share of a path that pictures may take, 0–1. */
  pictures: { share: number };
}

export function openSessions(
  options: SessionsOptions,
  { peer, streams, host, paths, welcome, ...given }: SessionsParts,
): OperatorSessions {
  const { id, places, watchersPoint, iceServers, pictures } = options;
  const { sensors, cameras, sound, budgets, sendLoop } = streams;
  const { videos } = cameras;
  const { capture } = sensors.first;
  return new OperatorSessions(
    {
      ...given,
      id,
      places,
      watchersPoint,
      iceServers,
      peer: { ...peer, pictures: capture.cameras.length > 0 },
      pictureShare: pictures.share,
      makeController: (transportFeedback) => makeRateController(options, transportFeedback),
      claims: () => sensors.claims,
      budgets,
      mostVideoBitsPerSecond: (video, codecs) => videos.mostBitsPerSecond(video, codecs),
      sendLoop,
      host,
    },
    {
      resume: (request, servers) => void paths.resume(request, servers),
      connected: (operator) => {
        welcome(operator);
        host.operatorCame();
        sound.welcome(operator);
        budgets.update();
      },
      cloudFormats: (operator) => sensors.announceTo(operator),
      needsKeyFrame: (video) => videos.requestKeyFrame(video),
      latencyFrameLost: () => capture.requestLatencyTest(),
      ended: (operator, end) => host.operatorGone(operator.id, end),
      left: (session) => host.driverLeaves({ id: session }),
    },
  );
}
