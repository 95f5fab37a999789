export { loadSend, type Send } from './addon.ts';
export { Notifier, type NotifyOrder, notifyOrder } from './notifier.ts';
