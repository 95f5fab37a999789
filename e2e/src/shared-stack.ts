/** The real signaling service and robots that the tests of one worker share. */
import { LocalStack, type RobotSpec } from '@farpoint/local-stack';
import { bridgedRobot, type MediaRobot, mediaRobot } from './robots.ts';

/** Of what the programs say, this many lines are kept. */
const MOST_LINES = 5000;

export class SharedStack {
  readonly stack: LocalStack;
  readonly #lines: string[];
  readonly #media = mediaRobot();
  readonly #started = new Map<string, Promise<void>>();

  private constructor(stack: LocalStack, lines: string[]) {
    this.stack = stack;
    this.#lines = lines;
  }

  /** Its robots start with the first test that asks for them. @param webRoot folder of the built page */
  static async start(webRoot: string): Promise<SharedStack> {
    const lines: string[] = [];
    const onLine = (name: string, line: string): void => {
      lines.push(`${new Date().toISOString()} ${name} ${line}`);
      if (lines.length > MOST_LINES) lines.shift();
    };
    return new SharedStack(await LocalStack.start({ webRoot, robots: [], onLine }), lines);
  }

  /** What the programs have said last. */
  get log(): string {
    return `${this.#lines.join('\n')}\n`;
  }

  async bridged(): Promise<typeof bridgedRobot> {
    await this.#start(bridgedRobot);
    return bridgedRobot;
  }

  async media(): Promise<MediaRobot> {
    await this.#start(this.#media.spec);
    return this.#media;
  }

  /** The value of a robot's metric, with its labels as in `/metrics`. */
  async metric(robotId: string, name: string): Promise<number> {
    const text = await (await fetch(`${this.stack.robotAdminUrl(robotId)}/metrics`)).text();
    const line = text.split('\n').find((each) => each.startsWith(`farpoint_robot_${name} `));
    return Number(line?.split(' ').at(-1));
  }

  async #start(robot: RobotSpec): Promise<void> {
    let starting = this.#started.get(robot.id);
    if (starting === undefined) {
      starting = this.stack.startRobot(robot);
      this.#started.set(robot.id, starting);
    }
    await starting;
  }
}
