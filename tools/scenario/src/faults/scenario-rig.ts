import { constantCapacity, type LinkProfile } from '@farpoint/network-sim';
import type { Command } from '@farpoint/protocol';
import type {
  Driving,
  FaultLink,
  FaultOperator,
  FaultyHand,
  FaultyRobot,
  LinkChange,
} from '@farpoint/robot-node/testing/faults';
import type { ScenarioOperator } from '../operator.ts';
import type { Scenario } from '../scenario.ts';

/** Resolves when something holds, at a whole millisecond of the virtual time, which somebody else must move on. */
function when(is: () => boolean): Promise<void> {
  return new Promise((resolve) => {
    const timer = setInterval(() => {
      if (!is()) return;
      clearInterval(timer);
      resolve();
    }, 1);
  });
}

class RigOperator implements FaultOperator {
  readonly #operator: ScenarioOperator;

  constructor(operator: ScenarioOperator) {
    this.#operator = operator;
  }

  readonly sendSession: FaultOperator['sendSession'] = (message) => this.#operator.link.sendSession(message);
  readonly sendControl: FaultOperator['sendControl'] = (message) => this.#operator.link.sendControl(message);
  readonly sendText = (text: string) => this.#operator.link.sendText(text);
  readonly closeControl = () => this.#operator.link.drop();
  readonly vanish = () => this.#operator.vanish();
  readonly close = () => this.#operator.link.drop();
  readonly releaseEstop = () => void this.#operator.client.releaseEstop();
  readonly estop = (latched: boolean) =>
    when(() => this.#operator.client.link.session.estop.latched === latched);
}

class RigLink implements FaultLink {
  readonly #operator: ScenarioOperator;

  constructor(operator: ScenarioOperator) {
    this.#operator = operator;
  }

  tell(change: LinkChange): void {
    const { up, down } = this.#operator;
    const directions = change.direction === 'both' ? [up, down] : [change.direction === 'up' ? up : down];
    for (const direction of directions) {
      if (change.type === 'blackhole') direction.blackhole(change.active);
      else if (change.type === 'pause') direction.pause(change.paused);
      else direction.set(profileOf(change));
    }
  }

  renumber(): void {
    this.#operator.link.renumber();
  }
}

function profileOf(change: Extract<LinkChange, { type: 'set' }>): Partial<LinkProfile> {
  const { delayMs, jitterMs, loss, rateMbps } = change;
  return {
    ...(delayMs === undefined ? {} : { delayMs }),
    ...(jitterMs === undefined ? {} : { jitterMs, jitterReorders: true }),
    ...(loss === undefined ? {} : { loss }),
    ...(rateMbps === undefined ? {} : { capacity: constantCapacity(rateMbps) }),
  };
}

class RigHand implements FaultyHand {
  readonly #operator: ScenarioOperator;

  constructor(operator: ScenarioOperator) {
    this.#operator = operator;
  }

  get newest(): Command | null {
    return this.#operator.hand.newest;
  }

  make(): Command {
    if (this.newest === null) throw new Error('the hand has given no command yet');
    return { ...this.newest, sequence: this.newest.sequence + 1, timeMs: performance.now() };
  }

  sends(alter: (command: Command) => Command | string | null): void {
    this.#operator.hand.sends(alter);
  }

  letGoOfStick(): void {
    this.#operator.hand.push(0);
  }
}

/** A scenario as the table of faults knows a robot. */
class ScenarioRig implements FaultyRobot {
  readonly link: FaultLink;
  readonly #scenario: Scenario;

  constructor(scenario: Scenario, driver: ScenarioOperator) {
    this.#scenario = scenario;
    this.link = new RigLink(driver);
  }

  async connect(): Promise<FaultOperator> {
    const operator = this.#scenario.operator();
    await when(() => operator.client.phase === 'live' && operator.client.telemetry !== null);
    return new RigOperator(operator);
  }

  startCamera(): void {
    this.#scenario.robot.camera = true;
  }

  stopCamera(): void {
    this.#scenario.robot.camera = false;
  }
}

/** An operator who drives in a scenario, as the table of faults knows it. */
export function drivingIn(scenario: Scenario, driver: ScenarioOperator): Driving {
  return {
    rig: new ScenarioRig(scenario, driver),
    operator: new RigOperator(driver),
    hand: new RigHand(driver),
  };
}

/** Seeds of links that lose packets and jump: the same on each run. */
const COUNT = 20;
export const SEEDS: readonly number[] = Array.from({ length: COUNT }, (_, i) => i + 2);
