export { loadSend, Notifier, type NotifyOrder, notifyOrder, type Send } from './notifier.ts';
