/** Gives the page a scripted robot instead of a link, if its address asks for one: `?stage=STATE`. */
import type { RobotClientOptions } from '@farpoint/operator';
import { CloudWorkerHere } from '@farpoint/operator/testing/cloud-worker-here';
import { MemoryWorkerHere } from '@farpoint/operator/testing/memory-worker-here';
import { PictureWorkerWatched } from '@farpoint/operator/testing/picture-worker-watched';
import { ScriptedLink } from '@farpoint/operator/testing/scripted-link';
import type { App } from '../page/app.ts';
import { ScriptedRobot } from './scripted-robot.ts';
import { StageControl } from './stage-control.ts';
import { isStageState, STAGE_STATES } from './stage-states.ts';

export interface OpenedStage {
  openLink: NonNullable<RobotClientOptions['openLink']>;
  /** The page is there, and has not started. */
  attach(app: App): void;
  /** The page has started. */
  opened(): void;
}

/** @returns `null` if the page is to have a link of its own */
export async function openStage(): Promise<OpenedStage | null> {
  const name = new URLSearchParams(window.location.search).get('stage');
  if (name === null) return null;
  if (!isStageState(name)) throw new Error(`there is no state ${name}`);
  const state = STAGE_STATES[name];
  const worker = await CloudWorkerHere.open();
  const robot = new ScriptedRobot();
  const stage = new StageControl(robot);
  stage.videos.install();
  useOwnWorkers(worker, stage);
  window.farpointStage = stage;
  for (const cloud of state.clouds ?? []) await stage.load(cloud);
  return {
    openLink: (_, events) => {
      stage.link = new ScriptedLink(worker, events, robot);
      return stage.link;
    },
    attach(app) {
      stage.app = app;
    },
    opened() {
      state.begin(stage);
      window.farpointStageOpened?.();
    },
  };
}

/** Those whose answers a test must know of. Other workers are real. */
function useOwnWorkers(clouds: CloudWorkerHere, stage: StageControl): void {
  const Real = globalThis.Worker;
  globalThis.Worker = new Proxy(Real, {
    construct(target, [url, options]: [URL | string, WorkerOptions | undefined]) {
      const script = String(url);
      if (script.includes('cloud-worker')) return clouds;
      if (script.includes('memory-worker')) return new MemoryWorkerHere();
      const real = new target(url, options);
      if (!script.includes('picture-worker')) return real;
      stage.pictureWorker = new PictureWorkerWatched(real);
      return stage.pictureWorker;
    },
  });
}
