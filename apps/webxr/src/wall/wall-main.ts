import '../ui/theme.css';
import './wall.css';
import { applyDisplay } from '../display/stored-display.ts';
import { byId } from '../ui/by-id.ts';
import { Wall } from './wall.ts';
import { readWallSettings } from './wall-settings.ts';

applyDisplay();
new Wall(
  {
    cells: byId('cells', HTMLElement),
    add: byId('add', HTMLButtonElement),
    stop: byId('stop-all', HTMLButtonElement),
    said: byId('said', HTMLElement),
    keys: byId('keys', HTMLElement),
  },
  readWallSettings(new URLSearchParams(window.location.search)),
  () => performance.now(),
).start();
