/** A second operator without a page, who hears where the robot is. */
import type { LocalStack } from '@farpoint/local-stack';
import { SignaledOperator } from '@farpoint/robot-node/testing';
import type { Watcher } from './operator-page.ts';

export class WatchingOperator implements Watcher {
  readonly #operator: SignaledOperator;

  private constructor(operator: SignaledOperator) {
    this.#operator = operator;
  }

  static async open(stack: LocalStack, robotId: string): Promise<WatchingOperator> {
    return new WatchingOperator(await SignaledOperator.connect(stack.signalingUrl, robotId));
  }

  get drive() {
    return this.#operator.client.telemetry?.drive;
  }

  async pose() {
    const pose = this.#operator.client.telemetry?.pose;
    if (pose === undefined) return null;
    const { position, orientation } = pose;
    return { x: position.x, y: position.y, yaw: 2 * Math.atan2(orientation.z, orientation.w) };
  }

  async stands() {
    const twist = this.#operator.client.telemetry?.twist;
    return twist === undefined ? null : twist.linear.x === 0 && twist.angular.z === 0;
  }

  /** Who drives, as the robot has said last. */
  get holder() {
    return this.#operator.client.session.findLast((message) => message.type === 'lease')?.holder;
  }

  close(): Promise<void> {
    return this.#operator.close();
  }
}
