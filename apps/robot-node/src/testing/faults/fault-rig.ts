import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { EmulatedLink, LocalStack, type ManagedProcess } from '@farpoint/local-stack';
import { CloudProducer } from '@farpoint/shared-memory';
import { SignaledOperator } from '../signaled-operator.ts';
import type { Driving, FaultLink, FaultOperator, FaultyRobot, LinkChange } from './fault.ts';
import { FaultHand, SPEED } from './fault-hand.ts';
import { WheelLog } from './wheel-log.ts';

const ROBOT = 'robot';
const POINTS = 1500;
const CAMERA_MS = 33;
/** For so long, at most, an interval between two pictures counts at the robot. */
const REMEMBERED_MS = 1100;
/** A busy machine may not let it drive undisturbed for that long: after this time, any driving counts as settled, ms. */
const SETTLING_MS = 8000;

/** A link between the real programs. */
class RealLink implements FaultLink {
  readonly emulated: EmulatedLink;

  constructor(emulated: EmulatedLink) {
    this.emulated = emulated;
  }

  tell(change: LinkChange): void {
    this.emulated.tell(change);
  }

  renumber(): Promise<unknown> {
    return this.emulated.renumber();
  }
}

/** An operator of the real robot program. */
class RealOperator implements FaultOperator {
  readonly client: SignaledOperator['client'];
  readonly #operator: SignaledOperator;

  constructor(operator: SignaledOperator) {
    [this.#operator, this.client] = [operator, operator.client];
  }

  readonly sendSession: FaultOperator['sendSession'] = (message) => this.client.sendSession(message);
  readonly sendControl: FaultOperator['sendControl'] = (message) => this.client.sendControl(message);
  readonly sendText = (text: string) => this.client.control.send(text);
  readonly closeControl = () => this.client.control.close();
  readonly vanish = () => this.client.vanish();
  readonly close = () => this.#operator.close();
  readonly releaseEstop = () => this.client.releaseEstop();
  readonly estop = (latched: boolean) => this.client.message('estop', (state) => state.latched === latched);
}

/** A real robot that is being driven. */
export interface RealDriving extends Driving {
  rig: FaultRig;
  operator: RealOperator;
  hand: FaultHand;
}

/** The real robot program between a camera and wheels in shared memory, and the operators of a test. */
export class FaultRig implements FaultyRobot {
  readonly stack: LocalStack;
  readonly wheels: WheelLog;
  readonly folder: string;
  link: RealLink | null = null;
  readonly #operators: RealOperator[] = [];
  readonly #hands: FaultHand[] = [];
  readonly #producer: CloudProducer;
  #camera: NodeJS.Timeout | null = null;

  private constructor(folder: string, stack: LocalStack, producer: CloudProducer) {
    this.folder = folder;
    this.stack = stack;
    this.#producer = producer;
    this.wheels = new WheelLog(folder);
    this.startCamera();
  }

  static async start(): Promise<FaultRig> {
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-faults-'));
    const producer = new CloudProducer({ folder, format: 'points', maxPoints: POINTS });
    const publish = setInterval(() => publishCloud(producer), CAMERA_MS);
    const args = ['--source', 'shm', '--shm-folder', folder, '--sink', 'shm'];
    const stack = await LocalStack.start({
      robots: [{ id: ROBOT, name: 'Robot', args: [...args, '--take-policy', 'always'] }],
    });
    clearInterval(publish);
    return new FaultRig(folder, stack, producer);
  }

  get robot(): ManagedProcess {
    return this.stack.robot(ROBOT);
  }

  async restartRobot(): Promise<void> {
    await this.stack.restartRobot(ROBOT);
  }

  /** @param behindLink whether all its packets go through a link that can be changed: {@link link} */
  async connect(behindLink = false): Promise<RealOperator> {
    if (behindLink)
      this.link ??= new RealLink(
        await EmulatedLink.start(this.stack, { args: ['--rate-mbps', '20', '--rtt-ms', '10'] }),
      );
    const url = behindLink && this.link !== null ? this.link.emulated.signalingUrl : this.stack.signalingUrl;
    const operator = new RealOperator(await SignaledOperator.connect(url, ROBOT));
    this.#operators.push(operator);
    return operator;
  }

  /** A hand that holds on, with the lease. */
  async hand({ client }: RealOperator): Promise<FaultHand> {
    // From whoever had it before, and may be gone without a word.
    client.sendSession({ type: 'leaseRequest', take: true });
    const { lease = '' } = await client.message('lease', ({ holder }) => holder === 'you');
    const hand = new FaultHand(client, lease);
    this.#hands.push(hand);
    return hand;
  }

  /** Resolves once the wheels turn as the hand asks, and its view has been fresh for a moment. */
  async untilDriving(hand: FaultHand): Promise<void> {
    let since = performance.now();
    const timer = setInterval(() => {
      if (performance.now() - since < 1000) return;
      since = performance.now();
      // The machine was too busy for a moment: as an operator would.
      void hand.gripAnew();
    }, 50);
    await this.wheels.until(({ linear }) => linear === SPEED);
    clearInterval(timer);
    await this.wheels.beats(10);
    if (this.wheels.speed !== SPEED) await this.untilDriving(hand);
  }

  /** Resolves once it has driven so for longer than the robot remembers what its driver saw, if the machine lets it. */
  async untilSettled(hand: FaultHand): Promise<void> {
    const beganMs = performance.now();
    for (;;) {
      await this.untilDriving(hand);
      const fromMs = performance.now();
      await this.wheels.until(({ linear, atMs }) => linear !== SPEED || atMs - fromMs > REMEMBERED_MS);
      if (this.wheels.speed === SPEED) return;
      if (performance.now() - beganMs > SETTLING_MS) return await this.untilDriving(hand);
    }
  }

  startCamera(): void {
    this.#camera ??= setInterval(() => publishCloud(this.#producer), CAMERA_MS);
  }

  stopCamera(): void {
    if (this.#camera !== null) clearInterval(this.#camera);
    this.#camera = null;
  }

  /** Everybody leaves, and everything that a fault changed is as it was. */
  async reset(): Promise<void> {
    for (const hand of this.#hands.splice(0)) hand.stop();
    this.startCamera();
    this.link?.emulated.tell({ type: 'reset' });
    this.link?.tell({ type: 'blackhole', direction: 'both', active: false });
    this.link?.tell({ type: 'pause', direction: 'both', paused: false });
    await Promise.all(this.#operators.splice(0).map((operator) => operator.close().catch(() => undefined)));
    await this.wheels.until(({ linear }) => linear === 0);
  }

  async close(): Promise<void> {
    this.stopCamera();
    for (const hand of this.#hands) hand.stop();
    await Promise.all(this.#operators.map((operator) => operator.close().catch(() => undefined)));
    this.wheels.close();
    await this.link?.emulated.stop();
    await this.stack.stop();
    this.#producer.close();
    rmSync(this.folder, { recursive: true, force: true });
  }
}

const points = Float32Array.from({ length: POINTS * 4 }, (_, i) => (i % 4 === 2 ? 2 : 0.5));

function publishCloud(producer: CloudProducer): void {
  producer.publish(
    { points },
    { capturedAtMs: null, width: 50, height: 30, pose: null, lens: null, latencyTest: false },
  );
}
