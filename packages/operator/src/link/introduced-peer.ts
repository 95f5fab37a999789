/** One session with a robot: its peer connection, and the introduction by signaling, which checks who the robot is. */
import type { IceServer, OperatorToService } from '@farpoint/protocol';
import type { ReceivedOffer, StrangeRobotError } from '../access/session-admission.ts';
import { RobotPeer, type RobotPeerEvents } from '../peer/robot-peer.ts';
import { Introduction } from './introduction.ts';
import type { WebRtcLinkOptions } from './webrtc-link-options.ts';

export interface IntroducedPeerOptions {
  session: string;
  robotId: string;
  /** Number of the session, for the worker's batches. */
  generation: number;
  link: WebRtcLinkOptions;
  iceServers: readonly IceServer[];
}

export interface IntroducedPeerEvents
  extends Omit<RobotPeerEvents, 'onAnswer' | 'onCandidate' | 'onVideoReceiver'> {
  /** To the signaling service. */
  send(message: OperatorToService): void;
  /** An offer that is not the robot's. Nothing of it was used. */
  onStranger(error: StrangeRobotError): void;
}

/** What {@link WebRtcLink} does with a peer. */
export type LinkPeer = Pick<
  IntroducedPeer,
  'offer' | 'candidate' | 'useIceServers' | 'sendSession' | 'sendControl' | 'sendBandwidth' | 'close'
>;

/** Makes the peer of a session. */
export type OpenPeer = (options: IntroducedPeerOptions, events: IntroducedPeerEvents) => LinkPeer;

export class IntroducedPeer extends RobotPeer {
  readonly #introduction: Introduction;

  constructor(options: IntroducedPeerOptions, events: IntroducedPeerEvents) {
    const { session, robotId, generation, link, iceServers } = options;
    const { worker, transform, icePolicy, onVideoReceiver, knownRobots, credentials = async () => [] } = link;
    super(
      { iceServers, icePolicy, worker, transform, generation },
      {
        ...events,
        onVideoReceiver,
        onAnswer: (sdp) => void this.#introduction.answer(sdp),
        onCandidate: (candidate) => events.send({ type: 'session.candidate', session, candidate }),
        onConnected: () => {
          this.#introduction.connected();
          events.onConnected();
        },
      },
    );
    this.#introduction = new Introduction(
      { robotId, session, known: knownRobots, credentials, nowS: () => Date.now() / 1000 },
      {
        onOffer: (sdp) => this.answer(sdp),
        onStranger: (error) => events.onStranger(error),
        send: (answer) => events.send(answer),
      },
    );
  }

  /** Checks an offer, and answers it if it is the robot's. */
  offer(offer: ReceivedOffer): void {
    this.#introduction.offer(offer);
  }

  override close(): void {
    this.#introduction.close();
    super.close();
  }
}
