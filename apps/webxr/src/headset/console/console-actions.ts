/** What the headset's console does to the page: the same as the page's own buttons. */
import type { HeadsetView } from '../rig-pose.ts';

export interface ConsoleActions {
  stop(): void;
  testLatency(): void;
  recentre(): void;
  /** Ends the headset's session. */
  leave(): void;
  show(view: HeadsetView): void;
  choose(robotId: string): void;
  disconnect(): void;
  takeOver(): void;
  handBack(): void;
  askToDrive(): void;
  /** @param operator the robot's number of its session */
  offerDrive(operator: number): void;
  /** Takes back what this operator has asked for or offered. */
  withdraw(handover: number): void;
  /** Answers another operator's request for the drive or offer of it. */
  answer(handover: number, accept: boolean): void;
  toggleVideo(index: number): void;
  togglePictures(index: number): void;
  toggleReadings(): void;
  pressCommand(id: string): void;
}
