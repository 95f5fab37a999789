/** Hands what an operator wants of the streams to the session's parts. */

import type { PathBudget } from '../../send/budgets/path-budget.ts';
import type { WantedClouds } from '../../send/clouds/wanted-clouds.ts';
import type { PictureSender } from '../../send/pictures/picture-sender.ts';
import type { OperatorSound } from '../../send/sound/operator-sound.ts';
import type { OperatorVideos } from '../../send/video/operator-videos.ts';
import type { OperatorSessionEvents, OperatorSessionOptions } from './operator-session-options.ts';
import type { WishesListener } from './operator-wishes.ts';

export interface WishedParts {
  clouds: WantedClouds;
  videos: OperatorVideos;
  pictures: PictureSender;
  sound: OperatorSound;
  budget: PathBudget;
  /** Discards what is waiting to be sent. */
  clear(): void;
  budgets: OperatorSessionOptions['budgets'];
  events: Pick<OperatorSessionEvents, 'onCloudFormats'>;
}

export function wishesListener(parts: WishedParts): WishesListener {
  const { clouds, videos, pictures, sound, budget, budgets, events } = parts;
  /** The operator's part of the path changes, or what it makes of it. */
  const budgeted =
    <Wish extends unknown[]>(take: (...wish: Wish) => void) =>
    (...wish: Wish): void => {
      take(...wish);
      budgets.update();
    };
  return {
    switchStream: budgeted((running) => {
      if (!running) parts.clear();
    }),
    wantSensors: budgeted((sensors) => {
      clouds.sensors = new Set(sensors);
      events.onCloudFormats();
    }),
    readFormats: budgeted((formats) => {
      clouds.formats = new Set(formats);
      events.onCloudFormats();
    }),
    fitDisplay: budgeted(({ framesPerSecond, points }) => {
      clouds.pace.display = { framesPerSecond, points };
    }),
    wantVideos: budgeted((wanted, barcode) => videos.want(wanted, barcode)),
    weigh: budgeted((shares) => budget.weigh(shares)),
    watchCameras: (cameras) => pictures.watch(cameras),
    listen: (on) => sound.listen(on),
    speak: (held) => sound.speak(held),
  };
}
