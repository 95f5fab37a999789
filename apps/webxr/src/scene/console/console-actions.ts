/** What the headset's console does to the page: the same as the page's own buttons. */
import type { HeadsetView } from '../../ground/headset-settings.ts';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import type { PageState } from '../../state/page-state.ts';

export interface ConsoleActions {
  stop(): void;
  testLatency(): void;
  recentre(): void;
  /** The next trigger or pinch points at the floor. */
  pointAtFloor(): void;
  /** Ends the headset's session. */
  leave(): void;
  show(view: HeadsetView): void;
  /** Connects to this robot. One that was chosen before is stopped first. */
  choose(robotId: string): void;
  disconnect(): void;
  takeOver(): void;
  giveUp(): void;
  askToDrive(): void;
  /** @param operator the robot's number of its session */
  offerDrive(operator: number): void;
  /** Takes back what this operator has asked for or offered. */
  withdraw(handover: number): void;
  /** Answers another operator's request for the drive or offer of it. */
  answer(handover: number, accept: boolean): void;
  /** A command's entry was chosen, as its button on the page is pressed. */
  pressCommand(id: string): void;
  cancelCommand(id: string): void;
  /** @param camera its place in the page's list of cameras */
  toggleCamera(camera: number): void;
  enlarge(camera: number): void;
  fill(camera: number): void;
}

/** What the cameras' entries do, by the page's state. */
export function cameraActions(
  state: Pick<PageState, 'views' | 'enlarged' | 'staged' | 'swap'>,
): Pick<ConsoleActions, 'toggleCamera' | 'enlarge' | 'fill'> {
  const { views, enlarged, staged } = state;
  const of = (camera: number, act: (view: CameraView) => void) => {
    const view = views.peek()[camera];
    if (view !== undefined) act(view);
  };
  return {
    toggleCamera: (camera) => of(camera, (view) => view.toggle()),
    enlarge: (camera) =>
      of(camera, (view) => {
        // One in front at a time.
        const before = staged.view.peek();
        if (before !== null) staged.toggle(before);
        enlarged.toggle(view);
      }),
    fill: (camera) => of(camera, (view) => state.swap(view)),
  };
}
