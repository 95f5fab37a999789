import '../../panels/ui/theme.css';
import './wall.css';
import { languageFor } from '../../ground/display/languages.ts';
import { applyDisplay } from '../../ground/display/stored-display.ts';
import { readWallSettings } from '../../ground/wall/wall-settings.ts';
import { speak, texts } from '../../words/language.ts';
import { Wall } from './wall.ts';
import { buildWall } from './wall-parts.ts';

async function open(): Promise<void> {
  applyDisplay();
  await speak(languageFor('system', navigator.languages));
  document.title = texts().wall.title;
  const parts = buildWall();
  document.body.append(parts.bar, parts.cells);
  const settings = readWallSettings(new URLSearchParams(window.location.search));
  new Wall(parts, settings, () => performance.now()).start();
}

void open();
