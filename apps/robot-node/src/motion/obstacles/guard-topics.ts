import type { Twist } from '@farpoint/protocol';
import { CollisionDemand, type CollisionState, type FloorPose, type MotionGuard } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { monotonicMs } from '../../ground/clock.ts';
import { CHECK_MS, KeptThread, REPLACE_MS } from '../../ground/threads/kept-thread.ts';
import { type GridShape, makeSharedGrid, SharedGridReader } from '../../sense/obstacles/shared-grid.ts';
import { SinkBeat } from '../drive/sink-beat.ts';
import { CollisionCells } from './collision-cells.ts';
import type {
  GuardTopicsOptions,
  GuardTopicsReport,
  GuardTopicsRequest,
  GuardTopicsSetup,
} from './guard-topics-messages.ts';

const PROGRAM = new URL('./guard-topics-worker.ts', import.meta.url);
/**
 * The longest wait before another thread is started, ms. Chosen: half of the usual, because the robot stands
 * or creeps meanwhile.
 */
const MOST_RETRY_MS = 5000;
/**
 * A thread that has lived this long was well: the next wait is short again, ms. Chosen: discovery and the
 * first messages come within seconds, so that a thread that fails at them is not called well.
 */
const WELL_MS = 10_000;

export interface GuardTopicsPlan extends GuardTopicsOptions {
  shape: GridShape;
  /** Whether odometry says where the robot is. */
  odometry: boolean;
  clearanceM: number;
  heightM: number;
  /** How far the footprint reaches from base_link, metres. */
  reachM: number;
}

/**
 * The topics of the robot's ROS graph that the obstacle guard hears, in a thread of their own. One that ends or hangs is
 * replaced; meanwhile nothing is heard, and silence bounds the motion.
 */
export class GuardTopics {
  /** Called when the motion may be bounded otherwise; it is bounded anew every few milliseconds anyway. */
  onChange: (() => void) | null = null;
  readonly topics: readonly string[];
  /** Bounds the motion by what the collision topic demands; `null` if there is none. */
  readonly collision: MotionGuard | null;
  readonly #demand: CollisionDemand | null;
  readonly #plan: GuardTopicsPlan;
  readonly #log: Pick<Logger, 'info' | 'warn' | 'error'>;
  readonly #thread: KeptThread<GuardTopicsReport>;
  readonly #checking: NodeJS.Timeout;
  #readers: readonly SharedGridReader[] = [];
  #cells = new CollisionCells();
  #beat = new SinkBeat();

  /** @param program of the thread; another one in tests */
  constructor(plan: GuardTopicsPlan, log: Pick<Logger, 'info' | 'warn' | 'error'>, program = PROGRAM) {
    const { collision, scans, reachM } = plan;
    this.#plan = plan;
    this.#log = log;
    this.topics = scans.map(({ topic }) => topic);
    const demand = collision === null ? null : new CollisionDemand({ ...collision, reachM });
    this.#demand = demand;
    this.collision =
      demand === null
        ? null
        : {
            bound: (wish, nowMs) => {
              this.#hear(demand, nowMs);
              return demand.bound(wish, nowMs);
            },
          };
    const closeMessage: GuardTopicsRequest = { type: 'close' };
    this.#thread = new KeptThread<GuardTopicsReport>({
      program,
      name: 'guard topics',
      mostRetryMs: MOST_RETRY_MS,
      wellAfterMs: WELL_MS,
      closeMessage,
      data: () => this.#setup(),
      onReport: (report) => this.#onReport(report),
      onError: (detail) => this.#tell(detail),
      onEnd: (inMs) => this.#onEnd(inMs),
    });
    this.#thread.start();
    this.#checking = setInterval(() => this.#check(), CHECK_MS);
  }

  /** How often the thread was replaced. */
  get restarts(): number {
    return this.#thread.restarts;
  }

  /** The grids of the scans, in their order. */
  get readers(): readonly SharedGridReader[] {
    return this.#readers;
  }

  /** What the collision topic says; `null` if there is none. */
  collisionState(nowMs: number): CollisionState | null {
    if (this.#demand === null) return null;
    this.#hear(this.#demand, nowMs);
    return this.#demand.state(nowMs);
  }

  /** Odometry came. */
  moved(pose: FloorPose, twist: Readonly<Twist> | null, atMs: number): void {
    if (this.topics.length > 0) this.#post({ type: 'pose', pose, twist, atMs });
  }

  close(): Promise<void> {
    clearInterval(this.#checking);
    return this.#thread.close();
  }

  #hear(demand: CollisionDemand, nowMs: number): void {
    const heard = this.#cells.read(nowMs);
    if (heard === null) return;
    if (heard.publishers === 0) demand.lose();
    else demand.hear(heard.mostMps, heard.atMs);
  }

  #setup(): GuardTopicsSetup {
    const { graph, scans, shape, odometry, clearanceM, heightM, collision, frames = null } = this.#plan;
    // What a thread that has ended left behind is not read any more.
    this.#cells = new CollisionCells();
    this.#beat = new SinkBeat();
    const memories = scans.map(() => makeSharedGrid(shape));
    this.#readers = memories.map((memory) => new SharedGridReader(memory, shape));
    return {
      graph,
      scans: scans.map(({ topic, mount }, i) => {
        const memory = memories[i] as SharedArrayBuffer;
        return { topic, guard: { memory, shape, mount, odometry, clearanceM, heightM } };
      }),
      collision: collision === null ? null : { ...collision, cells: this.#cells.memory },
      frames: scans.length > 0 ? frames : null,
      beat: this.#beat.memory,
    };
  }

  #onReport(report: GuardTopicsReport): void {
    if (report.type === 'changed') this.onChange?.();
    else if (report.type === 'failed') this.#tell(report.detail);
    else this.#log.warn({ detail: report.detail }, 'a topic of the obstacle guard has a fault');
  }

  #onEnd(inMs: number): void {
    this.#demand?.lose();
    this.#cells = new CollisionCells();
    this.onChange?.();
    this.#log.error(
      { inMs: Math.round(inMs) },
      'the thread that hears the obstacle guard’s topics has ended: starting another',
    );
  }

  #check(): void {
    if ((this.#beat.silentMs(monotonicMs()) ?? 0) > REPLACE_MS) this.#thread.terminate();
  }

  #tell(detail: string): void {
    this.#log.error({ detail }, 'the obstacle guard’s topics cannot be heard');
  }

  #post(request: GuardTopicsRequest): void {
    this.#thread.post(request);
  }
}
