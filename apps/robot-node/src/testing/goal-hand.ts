import { type GoalHold, type GoalRequest, type GoalState, goalHasEnded, stampUsOf } from '@farpoint/protocol';
import type { OperatorClient } from './operator-client.ts';

const HOLD_MS = 20;
/** A machine on which nothing happens for so long is stuck, ms. */
const PATIENCE_MS = 20_000;
/** States, of which the robot sends 20 a second. */
const STEADY = 20;

/** An operator for tests who sends the robot to places, and holds on to that. */
export class GoalHand {
  readonly lease: string;
  readonly #client: OperatorClient;
  #id = 0;
  #timer: NodeJS.Timeout | undefined;
  #alter: (hold: GoalHold) => GoalHold | string | null = (hold) => hold;
  /** The newest hold that was made. */
  newest: GoalHold | null = null;

  private constructor(client: OperatorClient, lease: string) {
    this.#client = client;
    this.lease = lease;
  }

  static async of(client: OperatorClient): Promise<GoalHand> {
    const lease = await client.takeLease();
    await client.until(() => client.telemetry !== null);
    // A robot that has just begun has pauses.
    const { sequence } = client.telemetry ?? { sequence: 0 };
    await client.until(() => (client.telemetry?.sequence ?? 0) >= sequence + STEADY);
    return new GoalHand(client, lease);
  }

  /** The goal's id. */
  get id(): number {
    return this.#id;
  }

  /** Sends the robot to a place that is so far from where it is, m, and holds on. */
  go(ahead: number, left = 0, change: Partial<GoalRequest> = {}): void {
    const { x = Number.NaN, y = Number.NaN } = this.#client.telemetry?.pose.position ?? {};
    this.#id++;
    const { id, lease } = this;
    const place = { x: x + ahead, y: y + left };
    this.#client.sendSession({ type: 'goal', id, timeMs: performance.now(), lease, ...place, ...change });
    this.hold();
  }

  /** @param alter what becomes of each hold from now on before it is sent; `null`: nothing is sent */
  sends(alter: (hold: GoalHold) => GoalHold | string | null): void {
    this.#alter = alter;
  }

  /** Holds on until it is told not to, whatever the robot says. */
  hold(): void {
    this.letGo();
    const client = this.#client;
    this.#timer = setInterval(() => {
      if (client.control.readyState !== 'open') return;
      if (client.telemetry !== null) client.hand.sees(stampUsOf(client.telemetry.timeMs));
      this.newest = client.hand.hold(this.lease, this.#id);
      const sent = this.#alter(this.newest);
      if (sent !== null) client.control.send(typeof sent === 'string' ? sent : JSON.stringify(sent));
    }, HOLD_MS);
  }

  letGo(): void {
    clearInterval(this.#timer);
  }

  /** Resolves when the robot has said that of the newest goal. @throws {Error} if it has ended otherwise */
  async told(state: GoalState['state']): Promise<GoalState> {
    const find = () => this.#told().find((each) => each.state === state);
    await this.#client.until(() => find() !== undefined || this.#hasEnded());
    return find() ?? this.#fail();
  }

  /** Resolves when something is so. It is looked at often. @throws {Error} if the newest goal has ended before */
  async until(is: () => boolean): Promise<void> {
    const untilMs = performance.now() + PATIENCE_MS;
    while (!is()) {
      if (this.#hasEnded()) this.#fail();
      if (performance.now() > untilMs) throw new Error('nothing has come of the goal');
      await new Promise((resolve) => setTimeout(resolve, 5));
    }
  }

  #told(): GoalState[] {
    const ofGoal = (each: { type: string }): each is GoalState =>
      each.type === 'goalState' && (each as GoalState).id === this.#id;
    return this.#client.session.filter(ofGoal);
  }

  #hasEnded(): boolean {
    return this.#told().some(({ state }) => goalHasEnded(state));
  }

  #fail(): never {
    const { state, reason } = this.#told().at(-1) ?? {};
    throw new Error(`the goal is ${state}: ${reason}`);
  }
}
