//! A thread that writes while the computation goes on.

use std::io;
use std::panic::resume_unwind;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::thread::{self, Builder, JoinHandle};

use super::error::OutputError;

/// Items that may wait for the thread; who hands over more waits as well, so that memory stays bounded.
const WAITING: usize = 2;

/// A thread that writes one item after the other, in the order in which they are handed over. After an error it writes
/// no more.
#[derive(Debug)]
pub(super) struct Background<T> {
    orders: Option<SyncSender<Order<T>>>,
    thread: Option<JoinHandle<Result<(), OutputError>>>,
}

#[derive(Debug)]
enum Order<T> {
    Write(T),
    /// To be answered when everything before is written.
    Tell(Sender<()>),
}

impl<T: Send + 'static> Background<T> {
    /// Starts the thread. Its name is that of the current one with `-out` after it.
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub(super) fn start(
        write: impl FnMut(T) -> Result<(), OutputError> + Send + 'static,
    ) -> io::Result<Self> {
        let (orders, received) = sync_channel(WAITING);
        let name = format!("{}-out", thread::current().name().unwrap_or_default());
        let thread = Builder::new()
            .name(name)
            .spawn(move || work(&received, write))?;
        Ok(Self {
            orders: Some(orders),
            thread: Some(thread),
        })
    }

    /// Hands an item over.
    ///
    /// # Errors
    ///
    /// That of an item before, or [`OutputError::Ended`] once it was told; this one is not written then.
    pub(super) fn write(&mut self, item: T) -> Result<(), OutputError> {
        self.order(Order::Write(item))
    }

    /// Waits until everything handed over is written.
    ///
    /// # Errors
    ///
    /// That of the first item that could not be.
    pub(super) fn flush(&mut self) -> Result<(), OutputError> {
        let (answer, answered) = channel();
        self.order(Order::Tell(answer))?;
        match answered.recv() {
            Ok(()) => Ok(()),
            // The thread ended before it came to the question.
            Err(_) => self.end(),
        }
    }

    fn order(&mut self, order: Order<T>) -> Result<(), OutputError> {
        match &self.orders {
            Some(orders) if orders.send(order).is_ok() => Ok(()),
            _ => self.end(),
        }
    }
}

impl<T> Background<T> {
    /// Ends the thread once it has written everything; what it ended with.
    fn end(&mut self) -> Result<(), OutputError> {
        self.orders = None;
        match self.thread.take().map(JoinHandle::join) {
            None => Err(OutputError::Ended),
            Some(Ok(result)) => result,
            Some(Err(panic)) => resume_unwind(panic),
        }
    }
}

impl<T> Drop for Background<T> {
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take() {
            // Who asks for errors flushes.
            let _ = thread.join();
        }
    }
}

fn work<T>(
    received: &Receiver<Order<T>>,
    mut write: impl FnMut(T) -> Result<(), OutputError>,
) -> Result<(), OutputError> {
    for order in received {
        match order {
            Order::Write(item) => write(item)?,
            // Who asked may be gone.
            Order::Tell(answer) => drop(answer.send(())),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    //! Protects what is written behind the computation: all of it, in order, and errors are told once and stop it.
    use std::sync::{Arc, Mutex};

    use super::*;

    fn refusing(from: usize) -> (Background<usize>, Arc<Mutex<Vec<usize>>>) {
        let written = Arc::new(Mutex::new(Vec::new()));
        let shared = Arc::clone(&written);
        let background = Background::start(move |item| {
            if item >= from {
                return Err(OutputError::Io {
                    path: "fields.vtu".into(),
                    source: io::Error::other("disk full"),
                });
            }
            shared.lock().unwrap().push(item);
            Ok(())
        });
        (background.unwrap(), written)
    }

    #[test]
    fn everything_is_written_in_order() {
        let (mut background, written) = refusing(usize::MAX);
        for item in 0..50 {
            background.write(item).unwrap();
        }
        background.flush().unwrap();
        assert_eq!(*written.lock().unwrap(), (0..50).collect::<Vec<_>>());
        background.write(50).unwrap();
        drop(background);
        assert_eq!(written.lock().unwrap().len(), 51);
    }

    #[test]
    fn an_error_comes_back_and_nothing_is_written_after_it() {
        let (mut background, written) = refusing(3);
        let mut items = 0..50;
        let refused = items.find_map(|item| background.write(item).err());
        assert!(refused.unwrap().to_string().contains("fields.vtu"));
        assert!(matches!(background.write(50), Err(OutputError::Ended)));
        assert_eq!(*written.lock().unwrap(), [0, 1, 2]);

        let (mut background, _) = refusing(0);
        background.write(0).unwrap();
        assert!(background.flush().is_err());
    }
}
