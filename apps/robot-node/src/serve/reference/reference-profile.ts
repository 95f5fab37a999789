/**
 * Makes the robot available on the reference system's signaling. It registers with a new offer whenever no operator
 * has taken its last one, so that the reference system's bridge, or ours, can show it. It serves one such operator at
 * a time, beside any number of Farpoint's own.
 *
 * Each registration has its own socket and ends with it. The reference signaling ignores a `deregister` of robot 0,
 * and reports that of others with a message type that its bridge does not know. A second registration on the same
 * socket would be listed beside the first, and answers to the first, dead offer would arrive as if they were for the
 * second.
 */

import type { RateController } from '@farpoint/congestion';
import {
  type IceServer,
  type ReferenceRobotToService,
  type ReferenceServiceToRobot,
  referenceRobotToServiceCodec,
  referenceServiceToRobotCodec,
} from '@farpoint/protocol';
import { answerMisfit, MessageLine } from '@farpoint/reference-profile';
import type { Logger } from '@farpoint/service';
import { FIRST_RETRY_MS } from '@farpoint/timing';
import type { SignalingOptions } from '../../admit/signaling/signaling-client.ts';
import type { Budgets } from '../../send/budgets/budgets.ts';
import type { FrameTarget } from '../../send/clouds/pipeline.ts';
import { makeRateController, type RateControlOptions } from '../../send/transport/make-rate-controller.ts';
import type { PacketLog } from '../../send/transport/packet-log.ts';
import type { SendLoop } from '../../send/transport/send-loop.ts';
import type { RobotSessionHost } from '../session/robot-session-host.ts';
import { type ReferenceHost, ReferenceOperator } from './reference-operator.ts';
import type { ReferencePeerOptions } from './reference-peer.ts';

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

export interface ReferenceProfileOptions {
  /** The reference signaling's port for robots. */
  url: string;
  ca: string | null;
  name: string;
  peer: ReferencePeerOptions;
  makeController: () => RateController;
  packetLog?: PacketLog | undefined;
  sendLoop: SendLoop;
  budgets: Pick<Budgets, 'update'>;
}

/**
 * The longest delay between two attempts, ms; the first is that of our own signaling. Chosen: a service that is down is
 * asked seldom.
 */
const MOST_RETRY_MS = 5000;
/**
 * After this long without hearing from an operator, another one may replace it, ms. As long as it may hold
 * the lease (reference-operator.ts).
 */
const REPLACE_AFTER_MS = 1000;

/**
 * Who comes so soon after one who held on when its session ended may be the same, with the hand still closed,
 * ms. Chosen: as long as a place is kept (robot-options.ts, docs/safety.md).
 */
const HELD_MS = 30_000;

export class ReferenceProfile {
  /** Counted since the start: offers made, operators connected, and operators that ended. */
  offers = 0;
  connected = 0;
  ended = 0;
  readonly #options: ReferenceProfileOptions;
  readonly #host: ReferenceHost;
  readonly #log: Logger;
  readonly #line: MessageLine<ReferenceServiceToRobot, ReferenceRobotToService>;
  #robotId: number | null = null;
  /** An operator that has an offer, and perhaps answered it, but is not connected. */
  #offered: ReferenceOperator | null = null;
  /**
   * The operator whose offer the signaling service has. Anything that arrived before this offer was meant for the
   * previous one.
   */
  #listed: ReferenceOperator | null = null;
  #current: ReferenceOperator | null = null;
  /** Whether another operator has answered the offer that this one took. */
  #rival = false;
  #retry: NodeJS.Timeout | null = null;
  #failures = 0;
  /** When a session ended whose operator may have held on, ms. */
  #heldMs = Number.NEGATIVE_INFINITY;
  #made = 0;
  #closed = false;

  constructor(options: ReferenceProfileOptions, host: ReferenceHost, log: Logger) {
    this.#options = options;
    this.#host = host;
    this.#log = log.child({ profile: 'reference' });
    // A robot that starts latched may have lost an operator who drove.
    if (host.drive.guard.estopState().latched) this.#heldMs = host.now();
    this.#line = new MessageLine(
      {
        url: options.url,
        incoming: referenceServiceToRobotCodec,
        outgoing: referenceRobotToServiceCodec,
        ca: options.ca,
      },
      {
        onOpen: () => void this.#register(),
        onMessage: (message) => this.#onMessage(message),
        onDown: (detail) => {
          this.#unlist();
          this.#log.warn(
            { url: options.url, detail },
            'no connection to the reference signaling; trying again',
          );
        },
      },
    );
  }

  get registered(): boolean {
    return this.#robotId !== null && this.#line.open;
  }

  get operator(): ReferenceOperator | null {
    return this.#current;
  }

  /** The targets of clouds: none or one. */
  get targets(): readonly FrameTarget[] {
    return this.#current === null ? [] : [this.#current];
  }

  /** Updates the operator, and closes a silent one that has a rival. Call this every 25 ms. */
  update(): void {
    const current = this.#current;
    current?.update();
    // If the operator that took the offer seems to be gone, make a new offer for the one that came after it.
    if (this.#rival && current !== null && current.silentMs(this.#host.now()) > REPLACE_AFTER_MS) {
      current.peer.close('closed', 'another operator is here');
    }
  }

  close(): void {
    this.#closed = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.#offered?.peer.close('closed', 'the robot is shutting down');
    this.#current?.peer.close('closed', 'the robot is shutting down');
    this.#line.close();
  }

  #onMessage(message: ReferenceServiceToRobot): void {
    switch (message.type) {
      case 'registered':
        this.#robotId = message.robotId;
        this.#listed = this.#offered;
        this.#log.info({ robotId: message.robotId }, 'registered');
        for (const candidate of this.#listed?.peer.candidates ?? []) this.#tell(candidate);
        break;
      case 'sdpAnswer':
        void this.#onAnswer(message.sdpAnswer);
        break;
      case 'candidate':
        // Also after connecting, because a better path may be found.
        this.#listed?.peer.addCandidate(message.candidate);
        break;
    }
  }

  async #onAnswer(sdp: string): Promise<void> {
    const listed = this.#listed;
    const misfit = answerMisfit(listed?.peer.offerSdp ?? '', sdp);
    if (misfit !== null) {
      this.#log.debug({ misfit }, 'an answer that is none to the offer');
    } else if (listed?.peer.state === 'offering') {
      await listed.peer.answer(sdp);
      for (const candidate of listed.peer.candidates) this.#tell(candidate);
    } else if (listed !== null && listed === this.#current) {
      // Another operator answered an offer that is already taken.
      this.#rival = true;
    }
  }

  /** Makes another offer on another socket. The service then lists the robot under another id. */
  #offerAnew(): void {
    this.#retry = null;
    if (this.#closed || !this.#line.open) return;
    this.#unlist();
    this.#line.reopen();
  }

  #unlist(): void {
    this.#robotId = null;
    this.#listed = null;
  }

  /** Called when the connection has just opened. */
  async #register(): Promise<void> {
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.#retry = null;
    const before = this.#offered;
    this.#offered = null;
    this.#unlist();
    before?.peer.close('closed', 'offered anew');
    const operator = this.#makeOperator();
    this.#offered = operator;
    this.offers++;
    try {
      const sdpOffer = await operator.peer.offer();
      if (this.#offered !== operator || this.#closed) return;
      this.#line.send({ type: 'register', name: this.#options.name, sdpOffer });
    } catch (error) {
      this.#log.error({ err: error }, 'no offer');
      operator.peer.close('not-connected', 'no offer could be made');
    }
  }

  #makeOperator(): ReferenceOperator {
    const { peer, makeController, packetLog, sendLoop, budgets } = this.#options;
    // No Farpoint session has a colon in its id.
    const id = `reference:${++this.#made}`;
    const mayHold = () => this.#host.now() - this.#heldMs < HELD_MS;
    const operator: ReferenceOperator = new ReferenceOperator(
      { id, peer, controller: makeController(), packetLog, mayHold, budgets },
      this.#host,
      sendLoop,
      {
        onCandidate: (candidate) => {
          if (operator === this.#offered) this.#tell(candidate);
        },
        onConnected: () => this.#onConnected(operator),
        onEnded: (end, detail) => this.#onEnded(operator, end, detail),
      },
    );
    return operator;
  }

  #onConnected(operator: ReferenceOperator): void {
    this.#log.info({ operator: operator.id }, 'reference operator connected');
    this.connected++;
    this.#failures = 0;
    const before = this.#current;
    this.#current = operator;
    this.#rival = false;
    if (this.#offered === operator) this.#offered = null;
    before?.peer.close('closed', 'another operator has connected');
    this.#options.budgets.update();
  }

  #onEnded(operator: ReferenceOperator, end: string, detail: string): void {
    if (operator.driver.holds(this.#host.now())) this.#heldMs = this.#host.now();
    this.ended++;
    this.#log.info({ operator: operator.id, end, detail }, 'reference operator ended');
    const wasOurs = operator === this.#current || operator === this.#offered;
    if (operator === this.#current) this.#current = null;
    if (operator === this.#offered) this.#offered = null;
    this.#options.budgets.update();
    if (this.#closed || !wasOurs || this.#offered !== null || this.#current !== null) return;
    const waitMs = Math.min(FIRST_RETRY_MS * 2 ** this.#failures++, MOST_RETRY_MS);
    this.#retry ??= setTimeout(() => this.#offerAnew(), waitMs);
  }

  #tell(candidate: string): void {
    if (this.#robotId !== null) this.#line.send({ type: 'candidate', robotId: this.#robotId, candidate });
  }
}
